#include "io/hdf5_document.hpp"

#include <fstream>
#include <string>
#include <string_view>

#include "io/atomic_file.hpp"

namespace packstone {
namespace {

Hdf5Handle create_file(const std::filesystem::path& path) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "new properties");
  // Metadata from library version 1.8 on carries checksums.
  check_hdf5(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST), "file version");
  const Hdf5Handle creation = timeless(H5P_FILE_CREATE);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "cannot be created"};
}

void write_attributes(hid_t root, const FileFormat& format) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "a new dataspace");
  const Hdf5Handle type = text_type(format.word.size(), H5T_CSET_UTF8);
  const Hdf5Handle word(H5Acreate2(root, "format", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                        "format");
  check_hdf5(H5Awrite(word, type, format.word.data()), "format");
  const Hdf5Handle version(
      H5Acreate2(root, "version", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      "version");
  check_hdf5(H5Awrite(version, H5T_NATIVE_INT, &format.version), "version");
}

Hdf5Handle open_attribute(hid_t root, const char* name, const FileFormat& format) {
  if (H5Aexists(root, name) <= 0) {
    throw InvalidArgument(std::string("attribute '") + name + "' is missing: not a " +
                          std::string(format.what));
  }
  return {H5Aopen(root, name, H5P_DEFAULT), H5Aclose, name};
}

void expect_single(const Hdf5Handle& attribute, const char* name) {
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, name);
  if (H5Sget_simple_extent_npoints(space) != 1) {
    throw InvalidArgument(std::string("attribute '") + name + "' must be a single value");
  }
}

std::string read_word(hid_t root, const FileFormat& format) {
  constexpr const char* kName = "format";
  const Hdf5Handle attribute = open_attribute(root, kName, format);
  expect_single(attribute, kName);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, kName);
  constexpr std::size_t kLongest = 4096;
  if (H5Tget_class(type) != H5T_STRING || H5Tget_size(type) > kLongest) {
    throw InvalidArgument("attribute 'format' must be a short text");
  }
  refuse_variable_text(type, kName);
  std::string text(H5Tget_size(type), '\0');
  check_hdf5(H5Aread(attribute, type, text.data()), kName);
  return text.substr(0, text.find_last_not_of('\0') + 1);
}

void check_attributes(hid_t root, const FileFormat& format) {
  check_format(read_word(root, format), format);
  const Hdf5Handle attribute = open_attribute(root, "version", format);
  expect_single(attribute, "version");
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "version");
  if (H5Tget_class(type) != H5T_INTEGER) throw InvalidArgument("version: must be an integer");
  int version = 0;
  check_hdf5(H5Aread(attribute, H5T_NATIVE_INT, &version), "version");
  check_version(version, format);
}

}  // namespace

void write_hdf5_here(const std::filesystem::path& path, const FileFormat& format,
                     const WriteMembers& write) {
  Hdf5Handle file = create_file(path);
  {
    const Hdf5Folder root(file, "");
    write_attributes(root.id(), format);
    write(root.id());
  }
  file.close("writing failed");
}

void write_hdf5(const std::filesystem::path& path, const FileFormat& format,
                const WriteMembers& write) {
  AtomicFile target(path);
  if (!target.replaces()) throw FileError(path.string() + ": is not a regular file");
  try {
    const Hdf5Session session;
    write_hdf5_here(target.temporary(), format, write);
  } catch (const InvalidArgument& problem) {
    throw FileError(path.string() + ": " + problem.what());
  }
  target.commit();
}

Hdf5Handle open_hdf5(const std::filesystem::path& path, const FileFormat& format) {
  Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
                  "cannot be read as HDF5");
  const Hdf5Handle root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose, "/");
  check_attributes(root, format);
  return file;
}

// The signature stands at the start of the file, or after a block of the user's.
bool has_checksums(const std::filesystem::path& path) {
  constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
  char start[kSignature.size() + 1] = {};
  std::ifstream(path, std::ios::binary).read(start, sizeof start);
  return std::string_view(start, kSignature.size()) == kSignature && start[kSignature.size()] >= 2;
}

}  // namespace packstone
