#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "output_file.hpp"
#include "packstone/core/error.hpp"
#include "packstone/io/draw_tessellation.hpp"
#include "packstone/io/export_tessellation.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/tessellate/laguerre.hpp"

namespace packstone::cli {
namespace {

struct TessellateArguments {
  std::string packing;
  std::vector<std::string> outputs;
  LaguerreOptions options;
  bool no_inflate = false;
  bool no_ordered_measures = false;
  bool no_keep_wall_cells = false;
  bool no_connected = false;
  bool published = false;
  std::string color = "group";
  bool inclusions = false;
  std::string time_limit;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

LaguerreOptions options_of(const TessellateArguments& arguments) {
  LaguerreOptions options = arguments.options;
  options.inflate = !arguments.no_inflate;
  options.ordered_measures = !arguments.no_ordered_measures;
  options.keep_wall_cells = !arguments.no_keep_wall_cells;
  options.connected = !arguments.no_connected;
  if (!arguments.published) return options;
  if (options.shape_rounds > 0) {
    throw InvalidArgument("--published has no rounds: leave --shape-rounds out");
  }
  options.inflate = published_laguerre().inflate;
  options.ordered_measures = published_laguerre().ordered_measures;
  return options;
}

LaguerreResult tessellate_with_progress(const Packing& packing,
                                        const TessellateArguments& arguments) {
  ProgressPrinter printer;
  const RunContext run =
      run_context(arguments.threads, arguments.time_limit, arguments.quiet, printer);
  return laguerre_tessellate(packing, options_of(arguments), run);
}

std::string_view name(LaguerreStop stop) {
  switch (stop) {
    case LaguerreStop::finished:
      return "finished";
    case LaguerreStop::stalled:
      return "stalled";
    case LaguerreStop::cancelled:
      return "cancelled";
    case LaguerreStop::out_of_time:
      return "out_of_time";
  }
  return "";
}

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

nlohmann::ordered_json errors_json(const LaguerreErrors& errors) {
  return {{"cells", errors.cells},
          {"measure_spread", errors.measure_spread},
          {"largest_measure_error", errors.largest_measure_error},
          {"elongated", errors.elongated},
          {"aspect_mean", errors.aspect_mean},
          {"aspect_spread", errors.aspect_spread},
          {"angle_mean", errors.angle_mean},
          {"angle_p95", errors.angle_p95},
          {"empty", errors.empty},
          {"in_parts", errors.in_parts}};
}

nlohmann::ordered_json result_json(const LaguerreResult& result,
                                   const std::vector<std::string>& files) {
  const LaguerreReport& report = result.report;
  return {{"files", files},
          {"stop", name(result.stop)},
          {"cells", result.tessellation.cells.size()},
          {"vertices", result.tessellation.vertices.size()},
          {"facets", result.tessellation.facets.size()},
          {"sites", report.sites},
          {"hidden_sites", report.hidden_sites},
          {"shape_rounds", report.shape_rounds},
          {"newton_steps", report.newton_steps},
          {"diagrams", report.diagrams},
          {"made", errors_json(report.made)},
          {"published", errors_json(report.published)}};
}

// Columns of the table of errors: name, spread, largest, aspect, angle, in parts, empty.
constexpr const char* kColumns = "  {:<9}{:>10}{:>10}{:>18}{:>17}{:>7}{:>7}\n";

// A dash where no cell is elongated.
std::string errors_line(const char* title, const LaguerreErrors& e) {
  std::string aspect = "-", angle = "-";
  if (e.elongated > 0) {
    aspect = fmt::format("{:.3f} +- {:.3f}", e.aspect_mean, e.aspect_spread);
    angle = fmt::format("{:.1f} / {:.1f} deg", degrees(e.angle_mean), degrees(e.angle_p95));
  }
  return fmt::format(kColumns, title, fmt::format("{:.2g}", e.measure_spread),
                     fmt::format("{:.2g}", e.largest_measure_error), aspect, angle, e.in_parts,
                     e.empty);
}

// What was made, and how it and the published cells differ from what is ordered.
std::string result_text(const LaguerreResult& result) {
  const LaguerreReport& report = result.report;
  const bool flat = result.tessellation.box.dimension == 2;
  std::string text =
      fmt::format("{} cells of {} {}, {} facets, {} Newton steps\n",
                  result.tessellation.cells.size(), report.sites, flat ? "circles" : "balls",
                  result.tessellation.facets.size(), report.newton_steps);
  text += fmt::format(kColumns, "", flat ? "area" : "volume", "largest", "aspect", "angle error",
                      "in", "");
  text +=
      fmt::format(kColumns, "", "spread", "error", "/ ordered", "mean / 95 %", "parts", "empty");
  return text + errors_line("made", report.made) + errors_line("published", report.published);
}

void print_result(const LaguerreResult& result, const TessellateArguments& arguments) {
  if (arguments.json) {
    fmt::print("{}\n", result_json(result, arguments.outputs).dump(2));
  } else if (!arguments.quiet) {
    fmt::print("{}\n{}", fmt::join(arguments.outputs, ", "), result_text(result));
  }
}

// Exit code of a run that is done and written; says on standard error what is not as asked.
int exit_code_of(LaguerreStop stop) {
  switch (stop) {
    case LaguerreStop::finished:
      return kDone;
    case LaguerreStop::stalled:
      fmt::print(stderr,
                 "packstone: the measures did not come as near to those ordered as asked\n");
      return kHonestNo;
    case LaguerreStop::out_of_time:
      fmt::print(stderr, "packstone: the time limit passed: the cells so far are kept\n");
      return kHonestNo;
    case LaguerreStop::cancelled:
      break;
  }
  fmt::print(stderr, "packstone: interrupted: the cells so far are kept\n");
  return kInterrupted;
}

bool is_picture(const std::filesystem::path& path) {
  return path.extension() == ".png" || path.extension() == ".svg";
}

// Polyhedra have fewer formats than polygons.
void check_outputs(const TessellateArguments& arguments, const Packing& packing) {
  if (packing.cell.dimension == 2) return;
  for (const std::filesystem::path output : arguments.outputs) {
    if (output.extension() != ".geo" && output.extension() != ".svg") continue;
    throw InvalidArgument("-o " + output.string() + ": holds polygons, and the cells of " +
                          arguments.packing + " are polyhedra; write .vtu, .tess, .csv or .png");
  }
  if (arguments.inclusions) {
    throw InvalidArgument("--inclusions: polyhedra hide the inclusions inside them");
  }
}

void write_files(const LaguerreResult& result, const Packing& packing,
                 const TessellateArguments& arguments) {
  DrawTessellationOptions look;
  look.picture.color_by = color_words().at(arguments.color);
  look.picture.cut = packing.cell.dimension == 2;
  look.inclusions = arguments.inclusions;
  for (const std::string& output : arguments.outputs) {
    if (is_picture(output)) {
      draw_tessellation(output, result.tessellation, packing, look,
                        RunContext{}.threads(arguments.threads));
    } else {
      export_tessellation(output, result.tessellation, packing);
    }
  }
}

int run_tessellate(const TessellateArguments& arguments) {
  for (const std::string& output : arguments.outputs) {
    check_output_file(output, {".vtu", ".tess", ".geo", ".csv", ".svg", ".png"});
  }
  const Packing packing = read_packing(arguments.packing);
  check_outputs(arguments, packing);
  const LaguerreResult result = tessellate_with_progress(packing, arguments);
  try {
    write_files(result, packing, arguments);
  } catch (const FileError& error) {
    fmt::print(stderr, "packstone: {}\n", error.what());
    return kHonestNo;
  }
  print_result(result, arguments);
  return exit_code_of(result.stop);
}

std::string check_spacing(const std::string& text) {
  double spacing = 0.0;
  const bool number = CLI::detail::lexical_cast(text, spacing);
  return number && spacing >= 0.01 && spacing <= 1.0 ? "" : text + "; allowed is 0.01 to 1";
}

void add_cell_options(CLI::App& command, TessellateArguments& arguments) {
  LaguerreOptions& options = arguments.options;
  command.add_option("--spacing", options.spacing, "Of the balls in each body, 0.01 to 1 [0.5]")
      ->type_name("S")
      ->check(CLI::Validator(check_spacing, ""));
  command
      .add_option("--shape-rounds", options.shape_rounds, "Rounds towards the shapes ordered [0]")
      ->type_name("N")
      ->check(CLI::Range(0, 1000).description(""));
  command.add_flag("--no-inflate", arguments.no_inflate, "Bodies do not grow first");
  command.add_flag("--no-ordered-measures", arguments.no_ordered_measures,
                   "Areas and volumes as they are found");
  command.add_flag("--no-keep-wall-cells", arguments.no_keep_wall_cells,
                   "Cells at walls are to measure as ordered, too");
  command.add_flag("--no-connected", arguments.no_connected, "Cells may come apart");
  command.add_flag("--published", arguments.published,
                   "The method as published: no growth, no weights");
}

}  // namespace

void add_tessellate(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<TessellateArguments>();
  CLI::App* command =
      app.add_subcommand("tessellate", "Polygons or polyhedra, one for each inclusion");
  add_packing(*command, arguments->packing);
  command
      ->add_option("-o,--output", arguments->outputs, "By ending: .vtu .tess .geo .csv .svg .png")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->required();
  add_cell_options(*command, *arguments);
  add_color(*command, arguments->color);
  command->add_flag("--inclusions", arguments->inclusions, "Draw the inclusions over the cells");
  add_time_limit(*command, arguments->time_limit);
  add_threads(*command, arguments->threads);
  command->add_flag("--quiet", arguments->quiet, "No progress, no summary");
  command->add_flag("--json", arguments->json, "Summary as one JSON object");
  command->footer("Example: packstone tessellate ellipses.json -o cells.vtu -o cells.png");
  command->callback([arguments, &exit_code] { exit_code = run_tessellate(*arguments); });
}

}  // namespace packstone::cli
