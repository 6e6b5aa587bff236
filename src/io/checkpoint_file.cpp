#include "packstone/io/checkpoint_file.hpp"

#include <string>
#include <vector>

#include "io/hdf5_document.hpp"
#include "io/hdf5_file.hpp"
#include "io/packing_hdf5.hpp"
#include "io/storable.hpp"
#include "packstone/core/error.hpp"

namespace packstone {
namespace {

void check_ending(const std::filesystem::path& path) {
  if (!is_checkpoint_file_name(path)) throw FileError(path.string() + ": checkpoints end in .h5");
}

void check_storable(const MovingPacking& moving) {
  check_storable(moving.packing);
  check_moving(moving);
  for (std::size_t i = 0; i < moving.numbers.size(); ++i) {
    check_text("numbers[" + std::to_string(i) + "]", moving.numbers[i].first);
  }
}

void write_vectors(Hdf5Folder& folder, const char* name, const std::vector<Vec3>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
  folder.column(name, values, 3);
}

void write_motion(hid_t root, const MovingPacking& moving) {
  Hdf5Folder folder(root, "motion");
  folder.scalar("size_factor", moving.size_factor);
  write_vectors(folder, "velocity", moving.velocity);
  write_vectors(folder, "angular_velocity", moving.angular_velocity);
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& [name, value] : moving.numbers) {
    names.push_back(name);
    values.push_back(value);
  }
  Hdf5Folder numbers(folder.id(), "numbers");
  numbers.column("name", names);
  numbers.column("value", values);
}

std::vector<Vec3> read_vectors(Hdf5Fields& fields, const char* name, std::size_t rows) {
  const std::vector<double> values = fields.number_column(name, rows, 3);
  std::vector<Vec3> vectors;
  vectors.reserve(rows);
  for (std::size_t i = 0; i < values.size(); i += 3) {
    vectors.push_back({values[i], values[i + 1], values[i + 2]});
  }
  return vectors;
}

void read_motion(Hdf5Fields fields, MovingPacking& moving) {
  const std::size_t rows = moving.packing.inclusions.size();
  moving.size_factor = fields.number("size_factor");
  moving.velocity = read_vectors(fields, "velocity", rows);
  moving.angular_velocity = read_vectors(fields, "angular_velocity", rows);
  Hdf5Fields numbers = fields.folder("numbers");
  const std::vector<std::string> names = numbers.texts("name");
  const std::vector<double> values = numbers.number_column("value", names.size(), 1);
  for (std::size_t i = 0; i < names.size(); ++i) moving.numbers.emplace_back(names[i], values[i]);
  numbers.finish();
  fields.finish();
}

MovingPacking read_members(Hdf5Fields& fields) {
  MovingPacking moving;
  moving.packing = read_packing_members(fields);
  read_motion(fields.folder("motion"), moving);
  return moving;
}

}  // namespace

bool is_checkpoint_file_name(const std::filesystem::path& path) {
  return path.extension() == ".h5";
}

void write_checkpoint(const std::filesystem::path& path, const MovingPacking& moving) {
  check_ending(path);
  check_storable(moving);
  write_hdf5(path, kCheckpointFormat, [&](hid_t root) {
    write_packing_members(root, moving.packing);
    write_motion(root, moving);
  });
}

MovingPacking read_checkpoint(const std::filesystem::path& path) {
  check_ending(path);
  return naming_file(path, [&] {
    const Hdf5Session session;
    static_cast<void>(std::filesystem::file_size(path));  // says why there is no such file
    // Only this program writes checkpoints, always with them; others can crash the library.
    if (!has_checksums(path)) throw InvalidArgument("not a checkpoint: no HDF5 with checksums");
    MovingPacking moving = read_hdf5_here(path, kCheckpointFormat, read_members);
    check_storable(moving);
    return moving;
  });
}

}  // namespace packstone
