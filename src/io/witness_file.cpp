#include "packstone/io/witness_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>

#include "packstone/core/error.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone {
namespace {

constexpr std::string_view kFirstLine = "# packstone-witness 1";
constexpr std::string_view kColumns =
    "# a,b,image_x,image_y,image_z,direction_x,direction_y,direction_z,gap";

template <class Number>
void append(std::string& text, Number value, char end) {
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  text += end;
}

// The fields of one line, from left to right.
class LineReader {
 public:
  LineReader(std::string_view line, std::string where) : rest_(line), where_(std::move(where)) {}

  template <class Number>
  void read(Number& value) {
    if (done_) fail("has fewer than 9 fields");
    const std::size_t comma = rest_.find(',');
    const std::string_view field = rest_.substr(0, comma);
    const auto [end, problem] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (problem != std::errc{} || end != field.data() + field.size()) {
      fail("has the field '" + std::string(field) + "', which is not a number of its kind");
    }
    done_ = comma == std::string_view::npos;
    if (!done_) rest_.remove_prefix(comma + 1);
  }
  void finish() const {
    if (!done_) fail("has more than 9 fields");
  }
  [[noreturn]] void fail(const std::string& what) const { throw FileError(where_ + " " + what); }

 private:
  std::string_view rest_;
  std::string where_;
  bool done_ = false;
};

PairWitness read_line(std::string_view line, const std::string& where) {
  LineReader fields(line, where);
  PairWitness w;
  fields.read(w.a);
  fields.read(w.b);
  for (int& periods : w.image) fields.read(periods);
  for (std::size_t axis = 0; axis < 3; ++axis) fields.read(w.direction[axis]);
  fields.read(w.gap);
  fields.finish();
  if (w.a < 0 || w.b < w.a) fields.fail("does not name a pair with 0 <= a <= b");
  if (!(std::abs(norm(w.direction) - 1.0) <= kUnitTolerance)) {
    fields.fail("has a direction that is not of length 1");
  }
  if (!std::isfinite(w.gap)) fields.fail("has a gap that is not finite");
  return w;
}

}  // namespace

std::string witnesses_to_text(const std::vector<PairWitness>& witnesses) {
  std::string text;
  text.reserve(64 + 100 * witnesses.size());
  text.append(kFirstLine).append("\n").append(kColumns).append("\n");
  for (const PairWitness& w : witnesses) {
    append(text, w.a, ',');
    append(text, w.b, ',');
    for (const int periods : w.image) append(text, periods, ',');
    for (std::size_t axis = 0; axis < 3; ++axis) append(text, w.direction[axis], ',');
    append(text, w.gap, '\n');
  }
  return text;
}

std::vector<PairWitness> witnesses_from_text(std::string_view text, const std::string& origin) {
  if (text.substr(0, text.find('\n')) != kFirstLine) {
    throw FileError(origin + ": the first line is not '" + std::string(kFirstLine) + "'");
  }
  std::vector<PairWitness> witnesses;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    witnesses.push_back(read_line(line, origin + ": line " + std::to_string(number)));
  }
  return witnesses;
}

void write_witnesses(const std::filesystem::path& path, const std::vector<PairWitness>& witnesses) {
  write_atomically(path, witnesses_to_text(witnesses));
}

std::vector<PairWitness> read_witnesses(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path.string() + ": cannot be opened");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw FileError(path.string() + ": cannot be read");
  return witnesses_from_text(text, path.string());
}

}  // namespace packstone
