# Install rules and the package file for find_package(packstone).
