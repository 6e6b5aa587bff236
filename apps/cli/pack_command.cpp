#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "interrupt.hpp"
#include "output_file.hpp"
#include "packstone/core/error.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/recipe/pack.hpp"
#include "packstone/recipe/recipe.hpp"
#include "progress_printer.hpp"
#include "summary.hpp"

namespace packstone::cli {
namespace {

struct PackArguments {
  std::string recipe;
  std::string output;
  std::optional<std::uint64_t> seed;
  std::string time_limit;
  std::vector<std::string> overrides;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

std::filesystem::path output_of(const PackArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  const std::filesystem::path recipe(arguments.recipe);
  // Beside a recipe that is itself a packing, the derived name could be its own.
  if (recipe.extension() != ".toml") {
    throw InvalidArgument(
        "-o is missing; the name of the packing is derived from .toml recipes only");
  }
  return recipe.stem().string() + ".json";
}

Recipe recipe_of(const PackArguments& arguments) {
  Recipe recipe = read_recipe(arguments.recipe, arguments.overrides);
  if (arguments.seed) recipe.seed = *arguments.seed;
  if (!arguments.time_limit.empty()) recipe.time_limit = seconds_in(arguments.time_limit);
  return recipe;
}

PackOutcome pack_with_progress(const Recipe& recipe, const PackArguments& arguments) {
  RunContext run;
  run.cancel_flag(&interrupt_flag()).threads(arguments.threads);
  if (arguments.quiet) return pack(recipe, run);
  ProgressPrinter printer;
  run.on_progress([&printer](const Progress& progress) { printer.print(progress); });
  return pack(recipe, run);
}

int exit_code_of(const PackOutcome& outcome) {
  if (outcome.target_reached) return kDone;
  return outcome.stop == "cancelled" ? kInterrupted : kHonestNo;
}

void print_outcome(const PackOutcome& outcome, const PackArguments& arguments,
                   const std::string& output) {
  if (arguments.json) {
    auto text = outcome_json(outcome);
    text["packing"] =
        output.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(output);
    fmt::print("{}\n", text.dump(2));
  } else if (!arguments.quiet) {
    fmt::print("{}{}", output.empty() ? "" : output + "\n", outcome_text(outcome));
  }
}

int run_pack(const PackArguments& arguments) {
  if (std::filesystem::is_directory(arguments.recipe)) {
    throw FileError("cannot read " + arguments.recipe + ": it is a folder, not a recipe");
  }
  const std::filesystem::path output = output_of(arguments);
  check_output_file(output, {".json", ".h5"});
  const Recipe recipe = recipe_of(arguments);
  const PackOutcome outcome = pack_with_progress(recipe, arguments);
  if (outcome.stop == "check_failed") {
    print_outcome(outcome, arguments, "");
    fmt::print(stderr, "packstone: {}\n  nothing was written; please report this as a defect\n",
               shortfall_text(outcome));
    return kHonestNo;
  }
  try {
    write_packing(output, outcome.packing);
  } catch (const FileError& error) {
    fmt::print(stderr, "packstone: {}\n", error.what());
    return kHonestNo;
  }
  print_outcome(outcome, arguments, output.string());
  if (!outcome.target_reached) {
    fmt::print(stderr, "packstone: {}\n  the best valid packing is in {}\n",
               shortfall_text(outcome), output.string());
  }
  return exit_code_of(outcome);
}

std::string check_time(const std::string& text) {
  return seconds_in(text)
             ? ""
             : text + "; allowed is a time > 0 such as \"30 s\", \"10 min\", \"1.5 h\"";
}

}  // namespace

void add_pack(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<PackArguments>();
  CLI::App* command = app.add_subcommand("pack", "Make the packing that a recipe orders");
  command->add_option("RECIPE", arguments->recipe, "Recipe (.toml), or a packing to make again")
      ->type_name("")
      ->required();
  command->add_option("-o,--output", arguments->output, "Packing to write [RECIPE's name, .json]")
      ->type_name("FILE.json|.h5");
  command->add_option("--seed", arguments->seed, "Instead of packing.seed")
      ->type_name("N")
      ->check(
          CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()).description(""));
  command->add_option("--set", arguments->overrides, "Change the recipe, as cell.size=[2,2,2]")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--time-limit", arguments->time_limit,
                   "Then keep what is valid: \"30 s\", \"10 min\"")
      ->type_name("TIME")
      ->check(CLI::Validator(check_time, ""));
  add_threads(*command, arguments->threads);
  command->add_flag("--quiet", arguments->quiet, "No progress, no summary");
  command->add_flag("--json", arguments->json, "Summary as one JSON object");
  command->footer(
      "--set takes keys as in the recipe, and groups by name or number:\n"
      "  --set inclusions.fibers.count=20 --set 'inclusions[0].fraction=0.1'\n\n"
      "Example: packstone pack fibers.toml -o fibers.json --seed 7");
  command->callback([arguments, &exit_code] { exit_code = run_pack(*arguments); });
}

}  // namespace packstone::cli
