#include "io/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <utility>

#include "packstone/core/error.hpp"

namespace packstone {
namespace {

std::atomic_flag library_in_use;

extern "C" herr_t keep_first_reason(unsigned depth, const H5E_error2_t* error, void* target) {
  // Called from C: the text is short and the string has room, so nothing is thrown through it.
  if (depth == 0 && error->desc != nullptr) *static_cast<const char**>(target) = error->desc;
  return 0;
}

// The deepest entry of the error stack says what was wrong, the others who asked.
std::string library_reason() {
  const char* reason = nullptr;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first_reason, &reason);
  return reason == nullptr ? "unknown reason" : reason;
}

[[noreturn]] void refuse(const std::string& what, const std::string& problem) {
  throw InvalidArgument(what + ": " + problem);
}

Hdf5Handle simple_space(const std::vector<hsize_t>& sizes) {
  return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose,
          "a new dataspace"};
}

Hdf5Handle scalar_space() { return {H5Screate(H5S_SCALAR), H5Sclose, "a new dataspace"}; }

Hdf5Handle open_or_create(hid_t parent, const std::string& name) {
  if (name.empty()) return {H5Gopen2(parent, "/", H5P_DEFAULT), H5Gclose, "/"};
  const Hdf5Handle properties = timeless(H5P_GROUP_CREATE);
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose, name};
}

struct LinkNames {
  std::vector<std::string> names;
  std::string not_hard;  ///< A link that leads elsewhere, perhaps out of the file.
};

extern "C" herr_t collect_link(hid_t, const char* name, const H5L_info_t* info, void* target) {
  try {
    auto& links = *static_cast<LinkNames*>(target);
    links.names.emplace_back(name);
    if (info->type != H5L_TYPE_HARD) links.not_hard = name;
    constexpr std::size_t kMoreThanAnyGroupHas = 64;
    return links.names.size() > kMoreThanAnyGroupHas ? -1 : 0;
  } catch (...) {
    return -1;
  }
}

std::vector<std::string> member_names(hid_t group, const std::string& path) {
  LinkNames links;
  check_hdf5(H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect_link, &links),
             path + ": members");
  if (!links.not_hard.empty()) refuse(joined(path, links.not_hard), "is a link");
  return std::move(links.names);
}

}  // namespace

Hdf5Handle timeless(hid_t property_class) {
  Hdf5Handle properties(H5Pcreate(property_class), H5Pclose, "new properties");
  check_hdf5(H5Pset_obj_track_times(properties, false), "time stamps");
  return properties;
}

Hdf5Session::Hdf5Session() {
  while (library_in_use.test_and_set()) library_in_use.wait(true);
  // The library would tidy up when the program ends, and where it has met a damaged file it then
  // complains without end or crashes. What is opened here is closed here.
  H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Session::~Hdf5Session() {
  H5Eset_auto2(H5E_DEFAULT, print_, print_data_);
  library_in_use.clear();
  library_in_use.notify_one();
}

Hdf5Handle::Hdf5Handle(hid_t id, Close closer, const std::string& what) : id_(id), close_(closer) {
  if (id < 0) refuse(what, library_reason());
}

Hdf5Handle::~Hdf5Handle() {
  if (id_ >= 0) close_(id_);
}

Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept
    : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

void Hdf5Handle::close(const std::string& what) {
  check_hdf5(close_(std::exchange(id_, -1)), what);
}

void check_hdf5(herr_t status, const std::string& what) {
  if (status < 0) refuse(what, library_reason());
}

void refuse_variable_text(hid_t type, const std::string& what) {
  if (H5Tis_variable_str(type) == 0) return;
  refuse(what, "must be text of fixed length (numpy type S), not of variable length");
}

Hdf5Handle text_type(std::size_t bytes, H5T_cset_t characters) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a new type");
  check_hdf5(H5Tset_size(type, bytes), "size of a text type");
  check_hdf5(H5Tset_strpad(type, H5T_STR_NULLPAD), "padding of a text type");
  check_hdf5(H5Tset_cset(type, characters), "characters of a text type");
  return type;
}

std::string joined(const std::string& folder, const std::string& name) {
  return folder.empty() ? name : name.empty() ? folder : folder + "/" + name;
}

// --- Writing

Hdf5Folder::Hdf5Folder(hid_t parent, const std::string& name)
    : group_(open_or_create(parent, name)) {}

void Hdf5Folder::write(const char* name, hid_t space, hid_t file_type, hid_t memory_type,
                       const void* data) {
  const Hdf5Handle properties = timeless(H5P_DATASET_CREATE);
  const Hdf5Handle dataset(
      H5Dcreate2(group_, name, file_type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
      name);
  check_hdf5(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
}

void Hdf5Folder::column(const char* name, const std::vector<double>& values, hsize_t width) {
  const std::vector<hsize_t> sizes = width == 0
                                         ? std::vector<hsize_t>{values.size()}
                                         : std::vector<hsize_t>{values.size() / width, width};
  write(name, simple_space(sizes), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
}

void Hdf5Folder::column(const char* name, const std::vector<std::int64_t>& values) {
  write(name, simple_space({values.size()}), H5T_STD_I64LE, H5T_NATIVE_INT64, values.data());
}

void Hdf5Folder::column(const char* name, const std::vector<std::int32_t>& values,
                        hid_t file_type) {
  // The library converts numbers to an enumeration only between enumerations: memory holds one too.
  const Hdf5Handle memory_type(H5Tget_class(file_type) == H5T_ENUM
                                   ? H5Tget_native_type(file_type, H5T_DIR_DEFAULT)
                                   : H5Tcopy(H5T_NATIVE_INT32),
                               H5Tclose, name);
  if (H5Tget_size(memory_type) == 1) {
    const std::vector<std::int8_t> bytes(values.begin(), values.end());
    return write(name, simple_space({values.size()}), file_type, memory_type, bytes.data());
  }
  write(name, simple_space({values.size()}), file_type, memory_type, values.data());
}

void Hdf5Folder::column(const char* name, const std::vector<std::string>& values) {
  write_text(name, simple_space({values.size()}), values);
}

void Hdf5Folder::scalar(const char* name, double value) {
  write(name, scalar_space(), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Folder::scalar(const char* name, std::int64_t value) {
  write(name, scalar_space(), H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void Hdf5Folder::scalar(const char* name, std::uint64_t value) {
  write(name, scalar_space(), H5T_STD_U64LE, H5T_NATIVE_UINT64, &value);
}

void Hdf5Folder::scalar(const char* name, const std::string& value) {
  write_text(name, scalar_space(), {value});
}

void Hdf5Folder::write_text(const char* name, hid_t space, const std::vector<std::string>& values) {
  std::size_t bytes = 1;
  for (const std::string& value : values) bytes = std::max(bytes, value.size());
  std::string block;
  for (const std::string& value : values) {
    block += value;
    block.append(bytes - value.size(), '\0');
  }
  const Hdf5Handle type = text_type(bytes, H5T_CSET_UTF8);
  write(name, space, type, type, block.data());
}

// --- Reading

Hdf5Fields::Hdf5Fields(hid_t parent, const std::string& name, std::uint64_t file_bytes)
    : path_(name),
      group_(H5Gopen2(parent, name.empty() ? "/" : name.c_str(), H5P_DEFAULT), H5Gclose,
             name.empty() ? "/" : name),
      file_bytes_(file_bytes),
      members_(member_names(group_, name)) {}

bool Hdf5Fields::has(const std::string& name) const {
  return std::find(members_.begin(), members_.end(), name) != members_.end();
}

Hdf5Fields Hdf5Fields::folder(const std::string& name) {
  if (!has(name)) refuse(joined(path_, name), "is missing");
  asked_.push_back(name);
  Hdf5Fields inner(group_, name, file_bytes_);
  inner.path_ = joined(path_, name);
  return inner;
}

Hdf5Fields::Dataset Hdf5Fields::open(const std::string& name) {
  const std::string path = joined(path_, name);
  if (!has(name)) refuse(path, "is missing");
  asked_.push_back(name);
  Hdf5Handle id(H5Dopen2(group_, name.c_str(), H5P_DEFAULT), H5Dclose, path);
  Hdf5Handle type(H5Dget_type(id), H5Tclose, path);
  const Hdf5Handle space(H5Dget_space(id), H5Sclose, path);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > 2 || H5Sget_simple_extent_type(space) == H5S_NULL) {
    refuse(path, "must be a number, a list or a table");
  }
  std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
  check_hdf5(H5Sget_simple_extent_dims(space, sizes.data(), nullptr), path);
  Dataset dataset{path, std::move(id), std::move(type), std::move(sizes)};
  check_storage(dataset);
  return dataset;
}

// A damaged or hostile file must not make us allocate what it cannot hold, read other files, or
// load filters from elsewhere.
void Hdf5Fields::check_storage(const Dataset& dataset) const {
  constexpr std::uint64_t kBestDeflate = 1100;  // no deflated data is denser than 1032 : 1
  const std::uint64_t most = kBestDeflate * file_bytes_;
  std::uint64_t bytes = std::max<std::uint64_t>(1, H5Tget_size(dataset.type));
  for (const hsize_t size : dataset.sizes) {
    if (size != 0 && bytes > most / size) refuse(dataset.path, "is larger than its file");
    bytes *= size;
  }
  // A single text has no extents, but a size of its own.
  if (bytes > most) refuse(dataset.path, "is larger than its file");
  const Hdf5Handle properties(H5Dget_create_plist(dataset.id), H5Pclose, dataset.path);
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (H5Pget_external_count(properties) != 0 || layout == H5D_VIRTUAL || layout < 0) {
    refuse(dataset.path, "keeps its values in another file");
  }
  const int filters = H5Pget_nfilters(properties);
  for (int i = 0; i < filters; ++i) {
    std::size_t values = 0;
    unsigned flags = 0;
    const H5Z_filter_t filter = H5Pget_filter2(properties, static_cast<unsigned>(i), &flags,
                                               &values, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32) {
      refuse(dataset.path, "is packed with a filter other than deflate, shuffle, fletcher32");
    }
  }
}

std::size_t Hdf5Fields::Dataset::count() const {
  std::size_t product = 1;
  for (const hsize_t size : sizes) product *= size;
  return product;
}

void Hdf5Fields::Dataset::expect_sizes(const std::vector<hsize_t>& expected) const {
  if (sizes == expected) return;
  const auto text = [](const std::vector<hsize_t>& list) {
    if (list.empty()) return std::string("a single value");
    std::string joined_sizes = std::to_string(list[0]);
    for (std::size_t i = 1; i < list.size(); ++i) joined_sizes += " x " + std::to_string(list[i]);
    return joined_sizes;
  };
  refuse(path, "must have size " + text(expected) + ", found " + text(sizes));
}

void Hdf5Fields::Dataset::expect_list() const {
  if (sizes.size() != 1) refuse(path, "must be a list");
}

std::vector<double> Hdf5Fields::read_numbers(const Dataset& dataset) {
  if (dataset.type_class() != H5T_FLOAT || H5Tget_size(dataset.type) > sizeof(double)) {
    refuse(dataset.path, "must be of type double");
  }
  std::vector<double> values(dataset.count());
  check_hdf5(H5Dread(dataset.id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
             dataset.path);
  return values;
}

// The library clips what does not fit the type in memory, silently: unsigned values are read as
// such, signed ones as such, and then compared.
std::vector<std::uint64_t> Hdf5Fields::read_unsigned(const Dataset& dataset) {
  if (dataset.type_class() == H5T_INTEGER && H5Tget_sign(dataset.type) == H5T_SGN_NONE &&
      H5Tget_size(dataset.type) <= 8) {
    std::vector<std::uint64_t> values(dataset.count());
    check_hdf5(H5Dread(dataset.id, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
               dataset.path);
    return values;
  }
  const std::vector<std::int64_t> signed_values = read_integers(dataset);
  for (const std::int64_t value : signed_values) {
    if (value < 0) refuse(dataset.path, std::to_string(value) + " is negative");
  }
  return {signed_values.begin(), signed_values.end()};
}

std::vector<std::int64_t> Hdf5Fields::read_integers(const Dataset& dataset) {
  const H5T_class_t type_class = dataset.type_class();
  if ((type_class != H5T_INTEGER && type_class != H5T_ENUM) || H5Tget_size(dataset.type) > 8) {
    refuse(dataset.path, "must be of an integer type");
  }
  if (type_class == H5T_INTEGER && H5Tget_sign(dataset.type) == H5T_SGN_NONE) {
    const std::vector<std::uint64_t> values = read_unsigned(dataset);
    for (const std::uint64_t value : values) {
      if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
        refuse(dataset.path, std::to_string(value) + " is too large");
      }
    }
    return {values.begin(), values.end()};
  }
  std::vector<std::int64_t> values(dataset.count());
  check_hdf5(H5Dread(dataset.id, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
             dataset.path);
  return values;
}

std::vector<std::string> Hdf5Fields::read_texts(const Dataset& dataset) {
  if (dataset.type_class() != H5T_STRING) refuse(dataset.path, "must be text");
  refuse_variable_text(dataset.type, dataset.path);
  const std::size_t bytes = H5Tget_size(dataset.type);
  const Hdf5Handle type = text_type(bytes, H5Tget_cset(dataset.type));
  const std::size_t count = dataset.count();
  std::vector<char> block(count * bytes);
  check_hdf5(H5Dread(dataset.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()), dataset.path);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string text(block.data() + i * bytes, bytes);
    texts.push_back(text.substr(0, text.find_last_not_of('\0') + 1));
  }
  return texts;
}

double Hdf5Fields::number(const std::string& name) {
  const Dataset dataset = open(name);
  dataset.expect_sizes({});
  return read_numbers(dataset)[0];
}

std::int64_t Hdf5Fields::integer(const std::string& name) {
  const Dataset dataset = open(name);
  dataset.expect_sizes({});
  return read_integers(dataset)[0];
}

std::uint64_t Hdf5Fields::unsigned_integer(const std::string& name) {
  const Dataset dataset = open(name);
  dataset.expect_sizes({});
  return read_unsigned(dataset)[0];
}

std::string Hdf5Fields::text(const std::string& name) {
  const Dataset dataset = open(name);
  dataset.expect_sizes({});
  return read_texts(dataset)[0];
}

std::vector<double> Hdf5Fields::numbers(const std::string& name) {
  const Dataset dataset = open(name);
  dataset.expect_list();
  return read_numbers(dataset);
}

std::vector<std::string> Hdf5Fields::texts(const std::string& name) {
  const Dataset dataset = open(name);
  dataset.expect_list();
  return read_texts(dataset);
}

std::vector<double> Hdf5Fields::number_column(const std::string& name, std::size_t rows,
                                              std::size_t width) {
  const Dataset dataset = open(name);
  dataset.expect_sizes(width == 1 ? std::vector<hsize_t>{rows} : std::vector<hsize_t>{rows, width});
  return read_numbers(dataset);
}

std::vector<std::int64_t> Hdf5Fields::integer_column(const std::string& name, std::size_t rows) {
  const Dataset dataset = open(name);
  dataset.expect_sizes({rows});
  return read_integers(dataset);
}

std::vector<std::int64_t> Hdf5Fields::word_column(const std::string& name,
                                                  const std::vector<std::string>& words) {
  const Dataset dataset = open(name);
  dataset.expect_list();
  const int members = dataset.type_class() == H5T_ENUM ? H5Tget_nmembers(dataset.type) : 0;
  for (int i = 0; i < members; ++i) {
    std::unique_ptr<char, herr_t (*)(void*)> member(
        H5Tget_member_name(dataset.type, static_cast<unsigned>(i)), H5free_memory);
    if (!member) refuse(dataset.path, library_reason());
    const auto place = std::find(words.begin(), words.end(), member.get());
    std::int64_t value = 0;
    std::array<unsigned char, 8> raw{};
    if (H5Tget_size(dataset.type) > raw.size()) refuse(dataset.path, "must be of a smaller type");
    check_hdf5(H5Tget_member_value(dataset.type, static_cast<unsigned>(i), raw.data()),
               dataset.path);
    const Hdf5Handle base(H5Tget_super(dataset.type), H5Tclose, dataset.path);
    check_hdf5(H5Tconvert(base, H5T_NATIVE_INT64, 1, raw.data(), nullptr, H5P_DEFAULT),
               dataset.path);
    std::copy(raw.begin(), raw.end(), reinterpret_cast<unsigned char*>(&value));
    if (place == words.end() || value != place - words.begin()) {
      refuse(dataset.path, "the enumeration gives '" + std::string(member.get()) + "' the value " +
                               std::to_string(value));
    }
  }
  return read_integers(dataset);
}

void Hdf5Fields::finish() const {
  for (const std::string& member : members_) {
    if (std::find(asked_.begin(), asked_.end(), member) != asked_.end()) continue;
    refuse(joined(path_, member), "unknown field");
  }
}

}  // namespace packstone
