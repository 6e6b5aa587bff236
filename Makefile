# What people type. Everything else is in CMakePresets.json and tools/.
.DEFAULT_GOAL := help
BUILD_JOBS ?= $(shell nproc)
PROGRAM := build/packstone
DEMO := fibers spheres ellipses_2d layered_ellipses grains_2d dense_ellipsoids relaxed_fibers

.PHONY: help setup setup-test build demo test validate bench build-reproduce reproduce reproduce-ghossein reproduce-salnikov reproduce-ilin pictures format check-format layers tidy sanitize tsan fuzz coverage install clean

help:  ## Show this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-18s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

setup:
	@tools/install_dependencies build

setup-test:
	@tools/install_dependencies build test

build: setup  ## Install what is missing, build build/packstone
	cmake --preset release $(CMAKE_FLAGS)
	cmake --build --preset release -j $(BUILD_JOBS)

demo: setup  ## Build, then pack, check, draw, tessellate and export the examples into demo/
	cmake --preset release -DPACKSTONE_BUILD_TESTS=OFF -DPACKSTONE_BUILD_BENCHMARKS=OFF $(CMAKE_FLAGS)
	cmake --build --preset release -j $(BUILD_JOBS)
	tools/demo $(PROGRAM) demo $(DEMO)

test: setup-test  ## Install, build, run all fast tests
	cmake --preset release -DPACKSTONE_BUILD_TESTS=ON -DPACKSTONE_BUILD_BENCHMARKS=ON $(CMAKE_FLAGS)
	cmake --build --preset release -j $(BUILD_JOBS)
	ctest --test-dir build -L fast -j $(BUILD_JOBS) --output-on-failure

validate:  ## Slow tests: published numbers, ten million pairs (needs make test before)
	ctest --test-dir build -L validation -j $(BUILD_JOBS) --output-on-failure

bench:  ## Build and run every benchmark (needs make test before)
	@for b in build/benchmarks/bench_*; do echo "== $$b"; $$b; done

REPRODUCE_TARGETS := packstone_cli bench_event_driven bench_rsa bench_relaxation bench_time_driven

build-reproduce:
	@tools/install_dependencies build reproduce
	cmake --preset release -DPACKSTONE_BUILD_BENCHMARKS=ON $(CMAKE_FLAGS)
	cmake --build --preset release -j $(BUILD_JOBS) --target $(REPRODUCE_TARGETS)

reproduce: reproduce-ghossein reproduce-salnikov reproduce-ilin  ## Measure what papers report; writes docs/reproduction/ (an hour)

reproduce-ghossein: build-reproduce  ## Only Ghossein and Levesque (2013)
	/usr/bin/python3 tools/reproduce_ghossein_levesque --build build

reproduce-salnikov: build-reproduce  ## Only Salnikov et al. (2014): tables, figures, pairs (five minutes)
	/usr/bin/python3 tools/reproduce_salnikov --build build

reproduce-ilin: build-reproduce  ## Only Ilin and Bernacki (2016): constructive packings and their cells (a quarter of an hour)
	/usr/bin/python3 tools/reproduce_ilin --build build

pictures: build-reproduce  ## Draw docs/algorithms/relaxation_gallery.md anew
	/usr/bin/python3 tools/show_relaxation --build build

format:  ## Format all C++ sources
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 -i

check-format: setup-test  ## Fail where formatting differs
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 --dry-run --Werror

layers:  ## Fail where a layer includes upward or sideways
	python3 tools/check_layers.py

tidy: setup-test  ## Static checks by clang-tidy (needs make test before)
	tools/run_tidy build $(BUILD_JOBS)

sanitize: setup-test  ## Fast tests under the address and undefined-behavior sanitizers
	cmake --preset asan-ubsan $(CMAKE_FLAGS)
	cmake --build --preset asan-ubsan -j $(BUILD_JOBS)
	ctest --test-dir build-asan-ubsan -L fast -j $(BUILD_JOBS) --output-on-failure

# Test programs whose code uses threads.
THREADED := core spatial structure generate tessellate measure io recipe

tsan: setup-test  ## Fast tests that use threads under the thread sanitizer
	cmake --preset tsan $(CMAKE_FLAGS)
	cmake --build --preset tsan -j $(BUILD_JOBS) --target $(THREADED:%=test_%)
	for t in $(THREADED); do ctest --test-dir build-tsan -R "^$$t\$$" --output-on-failure || exit 1; done

fuzz: setup-test  ## Build the fuzz targets and run each for a minute
	cmake --preset fuzz $(CMAKE_FLAGS)
	cmake --build --preset fuzz -j $(BUILD_JOBS)
	tools/run_fuzz build-fuzz 60

coverage: setup-test  ## Line coverage of the fast tests
	cmake --preset coverage $(CMAKE_FLAGS)
	cmake --build --preset coverage -j $(BUILD_JOBS)
	ctest --test-dir build-coverage -L fast -j $(BUILD_JOBS) --output-on-failure
	lcov --quiet --capture --directory build-coverage --output-file build-coverage/coverage.info
	lcov --quiet --extract build-coverage/coverage.info '*/include/packstone/*' '$(CURDIR)/src/*' '$(CURDIR)/apps/*' --output-file build-coverage/coverage.info
	lcov --summary build-coverage/coverage.info

install: build  ## Install program, library and package files (PREFIX=/usr/local)
	cmake --install build --prefix $(or $(PREFIX),/usr/local)

clean:  ## Remove everything that was built
	rm -rf build build-* demo
