#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "output_file.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/io/witness_file.hpp"
#include "packstone/structure/check_packing.hpp"
#include "summary.hpp"

namespace packstone::cli {
namespace {

struct CheckArguments {
  std::string packing;
  std::string witness;
  CheckOptions options;
  int threads = 0;
  bool json = false;
};

int run_check(const CheckArguments& arguments) {
  if (!arguments.witness.empty()) check_output_path(arguments.witness);
  const Packing packing = read_packing(arguments.packing);
  const RunContext run = RunContext{}.threads(arguments.threads);
  const Certificate certificate = check_packing(packing, arguments.options, run);
  if (!arguments.witness.empty()) {
    write_witnesses(arguments.witness, separating_directions(packing, arguments.options, run));
  }
  const std::optional<WallCrossing> crossing =
      certificate.outside_walls > 0 ? deepest_crossing(packing) : std::nullopt;
  if (arguments.json) {
    auto text = certificate_json(certificate);
    text["deepest_crossing"] = crossing_json(crossing);
    fmt::print("{}\n", text.dump(2));
  } else {
    fmt::print("{}", certificate_text(certificate, crossing));
  }
  return certificate.passed() ? kDone : kHonestNo;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check", "Prove that nothing overlaps, or say what does");
  add_packing(*command, arguments->packing);
  add_min_gap(*command, arguments->options.min_gap);
  command
      ->add_option("--witness", arguments->witness, "Write one separating direction per near pair")
      ->type_name("FILE");
  add_threads(*command, arguments->threads);
  command->add_flag("--json", arguments->json, "Certificate as one JSON object");
  command->footer(
      "Exit code 0 when every pair, over all periodic images, is proven apart and\n"
      "nothing crosses a wall; 1 when not.\n\n"
      "Example: packstone check fibers.json --min-gap 0.001");
  command->callback([arguments, &exit_code] { exit_code = run_check(*arguments); });
}

}  // namespace packstone::cli
