#include "recipe/size_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "packstone/core/error.hpp"

namespace packstone::recipe {
namespace {

std::vector<std::string> fields_of(std::string line) {
  std::replace_if(
      line.begin(), line.end(),
      [](char c) { return c == ',' || c == ';' || c == '\t' || c == '\r'; }, ' ');
  std::vector<std::string> fields;
  for (std::size_t begin = 0; (begin = line.find_first_not_of(' ', begin)) != std::string::npos;) {
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return fields;
}

// The number that is the whole of `text`, if finite.
std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc{} || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

// A line for a message: cut when long, and without what a terminal would act on.
std::string printable(std::string line) {
  constexpr std::size_t longest = 60;
  if (line.size() > longest) line = line.substr(0, longest - 3) + "...";
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return line;
}

}  // namespace

TableLaw read_size_table(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw FileError(path.string() + " is a folder");
  std::ifstream file(path);
  if (!file) throw FileError("cannot read " + path.string());
  TableLaw law;
  std::string line;
  int number = 0;
  for (bool heading = true; std::getline(file, line);) {
    ++number;
    const std::vector<std::string> fields = fields_of(line);
    if (fields.empty() || fields[0].front() == '#') continue;
    const auto value = number_in(fields[0]);
    const auto weight = fields.size() > 1 ? number_in(fields[1]) : 1.0;
    const bool words = heading && !value && !number_in(fields.back());
    heading = false;
    if (words) continue;
    if (!value || !weight || *weight < 0.0 || fields.size() > 2) {
      throw FileError(path.string() + ":" + std::to_string(number) + ": " + printable(line) +
                      "; allowed is \"value, weight\" with weight >= 0");
    }
    law.values.push_back(*value);
    law.weights.push_back(*weight);
  }
  if (law.values.empty()) throw FileError(path.string() + " has no values");
  return law;
}

}  // namespace packstone::recipe
