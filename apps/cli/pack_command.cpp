#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "interrupt.hpp"
#include "output_file.hpp"
#include "packstone/core/error.hpp"
#include "packstone/io/checkpoint_file.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/recipe/pack.hpp"
#include "packstone/recipe/recipe.hpp"
#include "progress_printer.hpp"
#include "realizations.hpp"
#include "summary.hpp"
#include "timeline.hpp"

namespace packstone::cli {
namespace {

constexpr std::int64_t kMostRealizations = 1'000'000;

struct PackArguments {
  std::string recipe;
  std::string output;
  std::optional<std::uint64_t> seed;
  std::string time_limit;
  std::vector<std::string> overrides;
  std::string timeline;
  std::string checkpoint;
  std::string resume;
  std::optional<std::int64_t> realizations;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

// What is to be packed, from the start or from where a checkpoint left it.
struct Job {
  Recipe recipe;
  std::optional<MovingPacking> checkpoint;
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

Job job_of(const PackArguments& arguments) {
  Job job;
  if (arguments.resume.empty()) {
    job.recipe = read_recipe(arguments.recipe, arguments.overrides);
  } else {
    job.checkpoint = read_checkpoint(arguments.resume);
    job.recipe = recipe_of_packing(job.checkpoint->packing, arguments.resume, arguments.overrides);
  }
  if (arguments.seed) job.recipe.seed = *arguments.seed;
  if (!arguments.time_limit.empty()) job.recipe.time_limit = seconds_in(arguments.time_limit);
  return job;
}

void check_files(const PackArguments& arguments, const std::filesystem::path& output) {
  check_output_file(output, {".json", ".h5"});
  if (!arguments.timeline.empty()) check_output_file(arguments.timeline, {".csv"}, "--timeline");
  if (arguments.checkpoint.empty()) return;
  check_output_file(arguments.checkpoint, {".h5"}, "--checkpoint");
  if (output == arguments.checkpoint) {
    throw InvalidArgument("--checkpoint " + arguments.checkpoint +
                          ": -o names the same file; allowed is another one");
  }
}

// A disk that is full for a while must not end the work: the next checkpoint may be written again.
Checkpointing checkpointing_of(const PackArguments& arguments) {
  if (arguments.checkpoint.empty()) return {};
  return {.write = [&path = arguments.checkpoint](const MovingPacking& state) {
    try {
      write_checkpoint(path, state);
    } catch (const FileError& error) {
      fmt::print(stderr, "packstone: {}; no checkpoint this time\n", error.what());
    }
  }};
}

PackOutcome run_job(Job job, const RunContext& run, const Checkpointing& checkpointing,
                    const PlanCallback& on_plan) {
  if (!job.checkpoint) return pack(job.recipe, run, checkpointing, on_plan);
  return resume_pack(job.recipe, std::move(*job.checkpoint), run, checkpointing);
}

PackOutcome pack_with_progress(Job job, const PackArguments& arguments) {
  ProgressPrinter printer;
  // The time limit is in the recipe.
  const RunContext run = run_context(arguments.threads, {}, arguments.quiet, printer);
  const auto tell = [](const PackPlan& plan) {
    fmt::print(stderr, "packstone: {}\n", plan_text(plan));
  };
  return run_job(std::move(job), run, checkpointing_of(arguments),
                 arguments.quiet ? PlanCallback{} : tell);
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

// Methods that move nothing have neither.
void say_what_is_not_there(const PackOutcome& outcome, const PackArguments& arguments) {
  const auto say = [&](const char* option, const std::string& file, bool there,
                       const char* reason) {
    if (there || file.empty()) return;
    fmt::print(stderr, "packstone: {} {}: not written; the method {} {}\n", option, file,
               outcome.method, reason);
  };
  say("--timeline", arguments.timeline, outcome.motion || outcome.relaxation || outcome.time_driven,
      "moves nothing");
  say("--checkpoint", arguments.checkpoint, outcome.motion.has_value(),
      outcome.relaxation || outcome.time_driven ? "keeps none" : "moves nothing");
}

void write_files(const PackOutcome& outcome, const PackArguments& arguments,
                 const std::filesystem::path& output) {
  write_packing(output, outcome.packing);
  if (arguments.timeline.empty()) return;
  if (outcome.motion) write_atomically(arguments.timeline, timeline_csv(outcome.motion->history));
  if (outcome.relaxation) {
    write_atomically(arguments.timeline, timeline_csv(outcome.relaxation->history));
  }
  if (outcome.time_driven) {
    write_atomically(arguments.timeline, timeline_csv(outcome.time_driven->history));
  }
}

void print_shortfall(const PackOutcome& outcome, const PackArguments& arguments,
                     const std::string& output) {
  const bool valid = outcome.packing.certificate->passed();
  fmt::print(stderr, "packstone: {}\n  {} is in {}\n", shortfall_text(outcome),
             valid ? "the best valid packing" : "the state that overlaps least, not valid,",
             output);
  const bool halted = outcome.stop == "cancelled" || outcome.stop == "out_of_time";
  if (!halted || !outcome.motion || arguments.checkpoint.empty()) return;
  fmt::print(stderr, "  go on with: packstone pack --resume {} -o {}\n", arguments.checkpoint,
             output);
}

int run_one(const PackArguments& arguments, const std::filesystem::path& output) {
  const PackOutcome outcome = pack_with_progress(job_of(arguments), arguments);
  if (outcome.stop == "check_failed") {
    print_outcome(outcome, arguments, "");
    fmt::print(stderr, "packstone: {}\n  nothing was written; please report this as a defect\n",
               shortfall_text(outcome));
    return kHonestNo;
  }
  try {
    write_files(outcome, arguments, output);
  } catch (const FileError& error) {
    fmt::print(stderr, "packstone: {}\n", error.what());
    return kHonestNo;
  }
  print_outcome(outcome, arguments, output.string());
  say_what_is_not_there(outcome, arguments);
  if (!outcome.target_reached) print_shortfall(outcome, arguments, output.string());
  return exit_code_of(outcome);
}

// Options that make no sense together.
void check_combination(const PackArguments& arguments) {
  const auto refuse = [](bool both, const std::string& one, const std::string& other) {
    if (both) throw InvalidArgument(one + " and " + other + " exclude each other");
  };
  const bool resumes = !arguments.resume.empty();
  const bool several = arguments.realizations.has_value();
  if (arguments.recipe.empty() && !resumes) {
    throw InvalidArgument("RECIPE is missing\n  see packstone pack --help");
  }
  refuse(resumes && !arguments.recipe.empty(), "--resume", "RECIPE");
  refuse(resumes && arguments.seed.has_value(), "--resume", "--seed");
  refuse(resumes && several, "--resume", "--realizations");
  refuse(several && !arguments.timeline.empty(), "--realizations", "--timeline");
  refuse(several && !arguments.checkpoint.empty(), "--realizations", "--checkpoint");
}

int run_pack(const PackArguments& arguments) {
  check_combination(arguments);
  if (std::filesystem::is_directory(arguments.recipe)) {
    throw FileError("cannot read " + arguments.recipe + ": it is a folder, not a recipe");
  }
  const std::filesystem::path output = output_of(arguments);
  check_files(arguments, output);
  if (!arguments.realizations) return run_one(arguments, output);
  return pack_realizations(job_of(arguments).recipe, {.count = *arguments.realizations,
                                                      .output = output,
                                                      .threads = arguments.threads,
                                                      .quiet = arguments.quiet,
                                                      .json = arguments.json});
}

void add_long_work(CLI::App& command, PackArguments& arguments) {
  command.add_option("--timeline", arguments.timeline, "Write the history of bodies that move")
      ->type_name("FILE.csv");
  command
      .add_option("--checkpoint", arguments.checkpoint, "Keep, each minute, a state to go on from")
      ->type_name("FILE.h5");
  command.add_option("--resume", arguments.resume, "Go on from a checkpoint instead of RECIPE")
      ->type_name("FILE.h5");
  command.add_option("--realizations", arguments.realizations, "K packings: seeds N, N + 1, ...")
      ->type_name("K")
      ->check(CLI::Range(std::int64_t{1}, kMostRealizations).description(""));
}

}  // namespace

void add_pack(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<PackArguments>();
  CLI::App* command = app.add_subcommand("pack", "Make the packing that a recipe orders");
  command->add_option("RECIPE", arguments->recipe, "Recipe (.toml), or a packing to make again")
      ->type_name("");
  command->add_option("-o,--output", arguments->output, "Packing to write [RECIPE's name, .json]")
      ->type_name("FILE.json|.h5");
  command->add_option("--seed", arguments->seed, "Instead of packing.seed")
      ->type_name("N")
      ->check(
          CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()).description(""));
  command->add_option("--set", arguments->overrides, "Change the recipe, as cell.size=[2,2,2]")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_time_limit(*command, arguments->time_limit);
  add_long_work(*command, *arguments);
  add_threads(*command, arguments->threads);
  command->add_flag("--quiet", arguments->quiet, "No progress, no summary");
  command->add_flag("--json", arguments->json, "Summary as one JSON object");
  command->footer(
      "Keys of --set are those of the recipe, such as inclusions.fibers.count=20\n\n"
      "Example: packstone pack fibers.toml -o fibers.json --seed 7");
  command->callback([arguments, &exit_code] { exit_code = run_pack(*arguments); });
}

}  // namespace packstone::cli
