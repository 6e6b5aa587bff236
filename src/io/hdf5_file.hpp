#pragma once

/// @file
/// HDF5 through handles that close themselves, and errors that are FileError.
///
/// The library is not safe for threads in the builds that systems ship, and keeps an error stack
/// and a printing hook of its own: every use stands inside one Hdf5Session.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace packstone {

/// Holds the library for one thread and keeps it silent.
class Hdf5Session {
 public:
  Hdf5Session();
  ~Hdf5Session();
  Hdf5Session(const Hdf5Session&) = delete;
  Hdf5Session& operator=(const Hdf5Session&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* print_data_ = nullptr;
};

/// An identifier of the library, closed by the function that belongs to its kind.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Throws InvalidArgument "`what`: reason of the library" when `id` says failure.
  Hdf5Handle(hid_t id, Close closer, const std::string& what);
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept;
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  operator hid_t() const { return id_; }  // NOLINT: stands for the identifier it owns
  /// Closes now and throws if that fails: the last bytes of a file are written then.
  void close(const std::string& what);

 private:
  hid_t id_;
  Close close_;
};

/// Properties to create a file, group or dataset by, without time stamps: the same packing makes
/// the same file.
[[nodiscard]] Hdf5Handle timeless(hid_t property_class);

/// Throws InvalidArgument "`what`: reason of the library" when `status` is negative.
void check_hdf5(herr_t status, const std::string& what);

/// Text of variable length lies in the global heap of the file, whose reader in library 1.10 runs
/// forever on some damaged files: InvalidArgument before anything is read.
void refuse_variable_text(hid_t type, const std::string& what);

/// Text of `bytes` bytes, filled up with zero bytes: unlike text of variable length it lies in one
/// piece, and readers in all languages know it.
[[nodiscard]] Hdf5Handle text_type(std::size_t bytes, H5T_cset_t characters);

/// "/cell" and "size" make "cell/size"; "" stands for the root.
[[nodiscard]] std::string joined(const std::string& folder, const std::string& name);

/// What is written below one group of a file.
class Hdf5Folder {
 public:
  /// A new group `name` below `parent`, or the root of the file when `name` is empty.
  Hdf5Folder(hid_t parent, const std::string& name);

  /// A column of `values.size() / width` rows; `width` 0 makes a list of numbers, not a table.
  void column(const char* name, const std::vector<double>& values, hsize_t width = 0);
  void column(const char* name, const std::vector<std::int64_t>& values);
  /// Values of an enumeration or of a small integer type of the file.
  void column(const char* name, const std::vector<std::int32_t>& values, hid_t file_type);
  void column(const char* name, const std::vector<std::string>& values);

  void scalar(const char* name, double value);
  void scalar(const char* name, std::int64_t value);
  void scalar(const char* name, std::uint64_t value);
  void scalar(const char* name, const std::string& value);

  [[nodiscard]] hid_t id() const { return group_; }

 private:
  void write(const char* name, hid_t space, hid_t file_type, hid_t memory_type, const void* data);
  void write_text(const char* name, hid_t space, const std::vector<std::string>& values);

  Hdf5Handle group_;
};

/// One group of a file that is read; strict as JsonFields is: every member asked for must be there,
/// be of the right type and size, and no other may be. Errors are InvalidArgument
/// "path/of/field: ...".
class Hdf5Fields {
 public:
  /// `parent` with an empty `name` is the root of a file of `file_bytes` bytes.
  Hdf5Fields(hid_t parent, const std::string& name, std::uint64_t file_bytes);

  /// The group `name` in this one.
  [[nodiscard]] Hdf5Fields folder(const std::string& name);
  [[nodiscard]] bool has(const std::string& name) const;

  double number(const std::string& name);
  std::int64_t integer(const std::string& name);
  std::uint64_t unsigned_integer(const std::string& name);
  std::string text(const std::string& name);

  /// Lists of any length.
  std::vector<double> numbers(const std::string& name);
  std::vector<std::string> texts(const std::string& name);

  /// Columns of `rows` rows.
  std::vector<double> number_column(const std::string& name, std::size_t rows, std::size_t width);
  std::vector<std::int64_t> integer_column(const std::string& name, std::size_t rows);
  /// As integer_column(). An enumeration in the file must give each of its names the value that its
  /// place in `words` has.
  std::vector<std::int64_t> word_column(const std::string& name,
                                        const std::vector<std::string>& words);

  /// Refuses members that were not asked for.
  void finish() const;

 private:
  /// A dataset that is safe to read: its sizes fit the file, its values stand in the file.
  struct Dataset {
    std::string path;
    Hdf5Handle id;
    Hdf5Handle type;
    std::vector<hsize_t> sizes;

    [[nodiscard]] std::size_t count() const;
    [[nodiscard]] H5T_class_t type_class() const { return H5Tget_class(type); }
    void expect_sizes(const std::vector<hsize_t>& expected) const;
    void expect_list() const;
  };

  Dataset open(const std::string& name);
  void check_storage(const Dataset& dataset) const;
  static std::vector<double> read_numbers(const Dataset& dataset);
  static std::vector<std::int64_t> read_integers(const Dataset& dataset);
  static std::vector<std::uint64_t> read_unsigned(const Dataset& dataset);
  static std::vector<std::string> read_texts(const Dataset& dataset);

  std::string path_;
  Hdf5Handle group_;
  std::uint64_t file_bytes_;
  std::vector<std::string> members_;
  std::vector<std::string> asked_;
};

}  // namespace packstone
