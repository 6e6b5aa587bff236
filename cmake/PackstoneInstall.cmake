# Install rules and the package file for find_package(packstone).
include(CMakePackageConfigHelpers)

# One name to link: every layer that is built.
add_library(packstone INTERFACE)
add_library(packstone::packstone ALIAS packstone)
set(packstone_layers)
foreach(layer core geometry spatial structure generate tessellate measure io recipe)
  target_link_libraries(packstone INTERFACE packstone_${layer})
  list(APPEND packstone_layers packstone_${layer})
endforeach()

install(TARGETS packstone ${packstone_layers} EXPORT packstone-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/packstone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT packstone-targets NAMESPACE packstone::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/packstone)

configure_package_config_file(cmake/packstone-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/packstone-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/packstone)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/packstone-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/packstone-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/packstone-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/packstone)
