#include "realizations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "interrupt.hpp"
#include "output_file.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/parallel.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/recipe/pack.hpp"
#include "progress_printer.hpp"
#include "summary.hpp"

namespace packstone::cli {
namespace {

namespace fs = std::filesystem;

// One of the packings.
struct Realization {
  std::uint64_t seed = 0;
  fs::path file;
  std::optional<PackOutcome> outcome;  // without inclusions: all of them would fill the memory
  std::string problem;                 // why nothing was written
};

std::vector<Realization> realizations_of(const Recipe& recipe,
                                         const RealizationArguments& arguments) {
  const auto count = static_cast<std::uint64_t>(arguments.count);
  constexpr auto kLastSeed = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (recipe.seed > kLastSeed - (count - 1)) {
    throw InvalidArgument(
        fmt::format("--realizations {}: with packing.seed = {} the last seed is "
                    "beyond {}",
                    count, recipe.seed, kLastSeed));
  }
  std::vector<Realization> all(count);
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::string file_name =
        fmt::format("{}-{}{}", arguments.output.stem().string(), recipe.seed + k,
                    arguments.output.extension().string());
    all[k].seed = recipe.seed + k;
    all[k].file = arguments.output.parent_path() / file_name;
    if (fs::is_directory(all[k].file)) {
      throw FileError(all[k].file.string() + " is a folder, not a file");
    }
  }
  check_output_path(all.front().file);
  return all;
}

void write(const PackOutcome& outcome, Realization& one) {
  if (outcome.stop == "check_failed") {
    one.problem = "the independent check did not pass; please report this as a defect";
  } else {
    write_packing(one.file, outcome.packing);
  }
}

// Errors are kept: they concern one packing, and must not end the others.
void make(Recipe recipe, const std::atomic<bool>& interrupted, Realization& one) {
  recipe.seed = one.seed;
  try {
    PackOutcome outcome = pack(recipe, RunContext{}.threads(1).cancel_flag(&interrupted));
    if (outcome.stop == "cancelled") return;
    write(outcome, one);
    outcome.packing.inclusions = {};
    one.outcome = std::move(outcome);
  } catch (const InvalidArgument& error) {
    one.problem = error.what();
  } catch (const FileError& error) {
    one.problem = error.what();
  }
}

void make_all(const Recipe& recipe, const RealizationArguments& arguments,
              const std::atomic<bool>& interrupted, std::vector<Realization>& all) {
  std::optional<ProgressPrinter> printer;
  if (!arguments.quiet) printer.emplace();
  std::mutex printing;
  std::int64_t done = 0;
  parallel_for(arguments.count, arguments.threads, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end && !interrupted; ++k) {
      make(recipe, interrupted, all[static_cast<std::size_t>(k)]);
      const std::lock_guard<std::mutex> alone(printing);
      ++done;
      if (!printer) continue;
      const double part = static_cast<double>(done) / static_cast<double>(arguments.count);
      printer->print({"realizations", part, 0.0, done, arguments.count});
    }
  });
}

nlohmann::ordered_json json_of(const Realization& one) {
  if (!one.outcome || !one.problem.empty()) {
    return {{"packing", nullptr}, {"seed", one.seed}, {"problem", one.problem}};
  }
  nlohmann::ordered_json text = outcome_json(*one.outcome);
  text["packing"] = one.file.string();
  return text;
}

void print_all(const std::vector<Realization>& all, bool json) {
  auto list = nlohmann::ordered_json::array();
  for (const Realization& one : all) {
    if (!one.outcome && one.problem.empty()) continue;  // interrupted
    if (json) {
      list.push_back(json_of(one));
    } else if (one.problem.empty()) {
      fmt::print("{}  {}\n", one.file.string(), outcome_line(*one.outcome));
    }
  }
  if (json) fmt::print("{}\n", list.dump(2));
}

void complain(const std::vector<Realization>& all) {
  for (const Realization& one : all) {
    if (!one.problem.empty()) {
      fmt::print(stderr, "packstone: seed {}: {}\n", one.seed, one.problem);
    } else if (one.outcome && !one.outcome->target_reached) {
      fmt::print(stderr, "packstone: {}: {}\n", one.file.string(), shortfall_text(*one.outcome));
    }
  }
}

}  // namespace

int pack_realizations(const Recipe& recipe, const RealizationArguments& arguments) {
  std::vector<Realization> all = realizations_of(recipe, arguments);
  const std::atomic<bool>& interrupted = interrupt_flag();
  make_all(recipe, arguments, interrupted, all);
  const auto count_if = [&all](auto&& holds) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), holds));
  };
  const std::size_t refused = count_if([](const Realization& r) { return !r.problem.empty(); });
  const std::size_t reached = count_if([](const Realization& r) {
    return r.problem.empty() && r.outcome && r.outcome->target_reached;
  });
  const bool nothing = count_if([](const Realization& r) { return r.outcome.has_value(); }) == 0;
  if (nothing && refused == all.size()) throw InvalidArgument(all.front().problem);
  if (!arguments.quiet || arguments.json) print_all(all, arguments.json);
  complain(all);
  if (interrupted) {
    fmt::print(stderr, "packstone: interrupted; {} of {} packings reached their target\n", reached,
               all.size());
    return kInterrupted;
  }
  return reached == all.size() ? kDone : kHonestNo;
}

}  // namespace packstone::cli
