// Time and rate of writing and reading packing files, and the state hash before and after.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/io/packing_file.hpp"
#include "scenes.hpp"

namespace {

using packstone::Packing;

Packing random_ellipsoids(int count) {
  Packing packing;
  packing.groups = {"grains"};
  for (int i = 0; i < count; ++i) {
    packstone::RandomStream random(1, packstone::StreamId::benchmark, static_cast<unsigned>(i));
    const packstone::Vec3 center{random.uniform(), random.uniform(), random.uniform()};
    const packstone::Vec3 axes{random.uniform(), random.uniform(), random.uniform()};
    packing.inclusions.push_back(
        {center, packstone::Ellipsoid{axes, packstone::random_rotation(random)}, 0});
  }
  return packing;
}

double median_cpu_seconds(const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int run = 0; run < 3; ++run) {
    const std::clock_t start = std::clock();
    work();
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[1];
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::stoi(argv[1]) : 1'000'000;
  const Packing packing = random_ellipsoids(count);
  const auto folder = std::filesystem::temp_directory_path();
  std::printf("%d ellipsoids, state %016llx\n", count,
              static_cast<unsigned long long>(packstone::scenes::state_hash(packing)));
  for (const char* name : {"packstone_bench.json", "packstone_bench.h5"}) {
    const std::filesystem::path path = folder / name;
    Packing read;
    const double write_s = median_cpu_seconds([&] { packstone::write_packing(path, packing); });
    const double read_s = median_cpu_seconds([&] { read = packstone::read_packing(path); });
    std::printf("%-6s write %6.3f s  read %6.3f s  %7.1f MB  state %016llx\n",
                path.extension().c_str(), write_s, read_s,
                static_cast<double>(std::filesystem::file_size(path)) / 1e6,
                static_cast<unsigned long long>(packstone::scenes::state_hash(read)));
    std::filesystem::remove(path);
  }
}
