#include <fmt/format.h>

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands.hpp"
#include "output_file.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/version.hpp"
#include "packstone/generate/relaxation.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/check_packing.hpp"
#include "progress_printer.hpp"
#include "summary.hpp"
#include "timeline.hpp"

namespace packstone::cli {
namespace {

struct RelaxArguments {
  std::string packing;
  std::string output;
  std::string timeline;
  double min_gap = 0.0;
  RelaxationTurn rotate = RelaxationTurn::hold_tensor;
  std::uint64_t seed = 1;
  std::string time_limit;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

// Bodies of a packing keep their places as long as pushing helps.
RelaxationOptions options_of(const RelaxArguments& arguments, const Packing& packing) {
  RelaxationOptions options;
  options.patience *= 5;
  options.min_gap = arguments.min_gap;
  options.turn.assign(packing.groups.size(), arguments.rotate);
  options.seed = arguments.seed;
  return options;
}

RelaxationResult relax_with_progress(const Packing& packing, const RelaxArguments& arguments) {
  ProgressPrinter printer;
  const RunContext run =
      run_context(arguments.threads, arguments.time_limit, arguments.quiet, printer);
  return relax(packing, options_of(arguments, packing), run);
}

// The recipe of the packing would not make this one again.
Provenance provenance_of(const RelaxationResult& result, const RelaxArguments& arguments) {
  return {.method = "relaxation",
          .stop = std::string(name(result.stop)),
          .version = std::string(version()),
          .seed = arguments.seed,
          .seconds = 0.0,
          .recipe_json = ""};
}

void print_result(const RelaxationResult& result, const std::optional<WallCrossing>& crossing,
                  const RelaxArguments& arguments) {
  const Certificate& certificate = *result.packing.certificate;
  if (arguments.json) {
    auto text = certificate_json(certificate);
    text["stop"] = name(result.stop);
    text["deepest_crossing"] = crossing_json(crossing);
    text["relaxation"] = relaxation_json(result.report);
    text["packing"] = arguments.output;
    fmt::print("{}\n", text.dump(2));
  } else if (!arguments.quiet) {
    fmt::print("{}\n{}\n{}", arguments.output, relaxation_text(result.report),
               certificate_text(certificate, crossing));
  }
}

void print_shortfall(const RelaxationResult& result, const std::optional<WallCrossing>& crossing,
                     const RelaxArguments& arguments) {
  fmt::print(stderr,
             "packstone: {}: not every gap could be opened\n  {}\n"
             "  the state that overlaps least is in {}\n",
             stop_words(std::string(name(result.stop))),
             problem_text(*result.packing.certificate, crossing), arguments.output);
}

void write_files(const RelaxationResult& result, const RelaxArguments& arguments) {
  write_packing(arguments.output, result.packing);
  if (arguments.timeline.empty()) return;
  write_atomically(arguments.timeline, timeline_csv(result.history));
}

int run_relax(const RelaxArguments& arguments) {
  check_output_file(arguments.output, {".json", ".h5"});
  if (!arguments.timeline.empty()) check_output_file(arguments.timeline, {".csv"}, "--timeline");
  RelaxationResult result = relax_with_progress(read_packing(arguments.packing), arguments);
  const RunContext whole = RunContext{}.threads(arguments.threads);
  result.packing.certificate = check_packing(result.packing, {.min_gap = arguments.min_gap}, whole);
  result.packing.provenance = provenance_of(result, arguments);
  try {
    write_files(result, arguments);
  } catch (const FileError& error) {
    fmt::print(stderr, "packstone: {}\n", error.what());
    return kHonestNo;
  }
  const Certificate& certificate = *result.packing.certificate;
  const std::optional<WallCrossing> crossing =
      certificate.passed() ? std::nullopt : deepest_crossing(result.packing);
  print_result(result, crossing, arguments);
  if (certificate.passed()) return kDone;
  print_shortfall(result, crossing, arguments);
  return result.stop == RelaxationStop::cancelled ? kInterrupted : kHonestNo;
}

}  // namespace

void add_relax(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<RelaxArguments>();
  CLI::App* command =
      app.add_subcommand("relax", "Open the gaps of a packing, or end its overlaps");
  add_packing(*command, arguments->packing);
  command->add_option("-o,--output", arguments->output, "Packing to write")
      ->type_name("FILE.json|.h5")
      ->required();
  add_min_gap(*command, arguments->min_gap);
  const std::map<std::string, RelaxationTurn> words{{"hold-tensor", RelaxationTurn::hold_tensor},
                                                    {"free", RelaxationTurn::free},
                                                    {"locked", RelaxationTurn::locked}};
  command->add_option("--rotate", arguments->rotate, "hold-tensor, free or locked [hold-tensor]")
      ->type_name("HOW")
      ->transform(CLI::CheckedTransformer(words).description(""));
  command->add_option("--seed", arguments->seed, "Of the places that stuck bodies are moved to [1]")
      ->type_name("N")
      ->check(
          CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()).description(""));
  command->add_option("--timeline", arguments->timeline, "Write the history of the energy")
      ->type_name("FILE.csv");
  add_time_limit(*command, arguments->time_limit);
  add_threads(*command, arguments->threads);
  command->add_flag("--quiet", arguments->quiet, "No progress, no summary");
  command->add_flag("--json", arguments->json, "Certificate as one JSON object");
  command->footer(
      "Sizes stay; inclusions move and turn until every gap exceeds the one asked for.\n\n"
      "Example: packstone relax fibers.json --min-gap 0.002 -o wider.json");
  command->callback([arguments, &exit_code] { exit_code = run_relax(*arguments); });
}

}  // namespace packstone::cli
