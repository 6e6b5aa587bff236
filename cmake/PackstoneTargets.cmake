# Flags that every target of the project shares.
#
# -ffp-contract=off: a fused multiply-add would make results depend on the compiler's choice.
# -fno-math-errno:   sqrt as one instruction; no result changes, only errno is left alone.
add_library(packstone_flags INTERFACE)
target_compile_options(packstone_flags INTERFACE
  -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  -Wno-sign-conversion)
if(PACKSTONE_WARNINGS_AS_ERRORS)
  target_compile_options(packstone_flags INTERFACE -Werror)
endif()

# packstone_layer(name SOURCES a.cpp ... PUBLIC lib ... PRIVATE lib ...)
#
# One static library per layer, so that the linker sees the order of the layers too.
function(packstone_layer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(packstone_${name} STATIC ${ARG_SOURCES})
  add_library(packstone::${name} ALIAS packstone_${name})
  set_target_properties(packstone_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(packstone_${name} PUBLIC cxx_std_20)
  target_include_directories(packstone_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(packstone_${name} PUBLIC ${ARG_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:packstone_flags> ${ARG_PRIVATE})
endfunction()

# packstone_test(name SOURCES a.cpp ... LINKS lib ... [LABELS l ...])
#
# One Catch2 program per layer. Cases tagged [validation] are slow: they run as a test of their own
# with the label "validation", and not otherwise.
function(packstone_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests
                                                  ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(test_${name} PRIVATE packstone_test_main packstone_scenes packstone_flags
                                             ${ARG_LINKS})
  add_test(NAME ${name} COMMAND test_${name} "~[validation]")
  add_test(NAME ${name}_validation COMMAND test_${name} "[validation]")
  set_tests_properties(${name} ${name}_validation PROPERTIES ENVIRONMENT
                       TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/tsan.supp)
  set_tests_properties(${name} PROPERTIES LABELS fast)
  set_tests_properties(${name}_validation PROPERTIES LABELS validation
                       SKIP_REGULAR_EXPRESSION "No test cases matched")
endfunction()
