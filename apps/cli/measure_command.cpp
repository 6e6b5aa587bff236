#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "density_summary.hpp"
#include "output_file.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MeasureArguments {
  std::string packing;
  std::string output;
  std::vector<std::string> only;
  DensityOptions density;
  int threads = 0;
  bool json = false;
};

// What one measure says of a packing.
struct Measured {
  std::string text;
  Json json;
};

struct Measure {
  std::string_view name;
  Measured (*take)(const Packing& packing, const MeasureArguments& arguments);
};

Measured take_density(const Packing& packing, const MeasureArguments& arguments) {
  const DensityReport report =
      measure_density(packing, arguments.density, RunContext().threads(arguments.threads));
  return {density_text(report, packing.cell.dimension), density_json(report)};
}

// In the order of the report.
constexpr std::array kMeasures{Measure{"density", take_density}};

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  names.reserve(kMeasures.size());
  for (const Measure& measure : kMeasures) names.emplace_back(measure.name);
  return names;
}

bool is_wanted(const Measure& measure, const MeasureArguments& arguments) {
  const std::vector<std::string>& only = arguments.only;
  return only.empty() || std::find(only.begin(), only.end(), measure.name) != only.end();
}

int run_measure(const MeasureArguments& arguments) {
  if (!arguments.output.empty()) check_output_file(arguments.output, {".json"});
  const Packing packing = read_packing(arguments.packing);
  Json report{{"packing", arguments.packing}};
  std::string text;
  for (const Measure& measure : kMeasures) {
    if (!is_wanted(measure, arguments)) continue;
    Measured measured = measure.take(packing, arguments);
    report[std::string(measure.name)] = std::move(measured.json);
    text += measured.text;
  }
  if (!arguments.output.empty()) write_atomically(arguments.output, report.dump(2) + "\n");
  fmt::print("{}", arguments.json ? report.dump(2) + "\n" : text);
  return kDone;
}

void add_density_options(CLI::App& command, DensityOptions& options) {
  command
      .add_option("--wall-margin", options.wall_margin,
                  "Window: distance from walls and floor\n[two largest half widths]")
      ->type_name("M")
      ->check(number_at_least_zero());
  command
      .add_option("--top-margin", options.top_margin,
                  "Window: distance from the top of what stands\n[four largest half widths]")
      ->type_name("M")
      ->check(number_at_least_zero());
  command
      .add_option("--bin-width", options.bin_width,
                  "Slabs of the profiles, at most\n[a quarter of the largest half width]")
      ->type_name("W")
      ->check(number_above_zero());
}

}  // namespace

void add_measure(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<MeasureArguments>();
  CLI::App* command =
      app.add_subcommand("measure", "Density: whole, interior, and what walls and top cost");
  add_packing(*command, arguments->packing);
  command->add_option("-o,--output", arguments->output, "Write the report, with profiles")
      ->type_name("FILE.json");
  command->add_option("--only", arguments->only, "Only this measure: density [all]")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->check(CLI::IsMember(measure_names()).description(""));
  add_density_options(*command, arguments->density);
  add_threads(*command, arguments->threads);
  command->add_flag("--json", arguments->json, "The report as one JSON object");
  command->footer("Example: packstone measure disks.json -o report.json");
  command->callback([arguments, &exit_code] { exit_code = run_measure(*arguments); });
}

}  // namespace packstone::cli
