#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "output_file.hpp"
#include "packstone/core/error.hpp"
#include "packstone/io/packing_file.hpp"
#include "templates.hpp"

namespace packstone::cli {
namespace {

struct NewArguments {
  std::string name;
  std::string output;
  bool list = false;
};

// The first line of a template says what it is: "# fibers.toml: short fibers ..."
std::string_view headline(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const auto colon = line.find(": ");
  return colon == std::string_view::npos ? line : line.substr(colon + 2);
}

void print_list() {
  for (const Template& one : templates()) {
    fmt::print("{:<12}{}\n", one.name, headline(one.text));
  }
}

std::string_view text_of(const std::string& name) {
  std::vector<std::string_view> known;
  for (const Template& one : templates()) {
    if (one.name == name) return one.text;
    known.push_back(one.name);
  }
  throw InvalidArgument(
      fmt::format("no template \"{}\"; allowed is one of {}", name, fmt::join(known, ", ")));
}

int run_new(const NewArguments& arguments) {
  if (arguments.list || arguments.name.empty()) {
    if (!arguments.list) throw InvalidArgument("TEMPLATE is missing; see packstone new --list");
    print_list();
    return kDone;
  }
  const std::string_view text = text_of(arguments.name);
  if (arguments.output.empty()) {
    fmt::print("{}", text);
    return kDone;
  }
  check_output_file(arguments.output, {".toml"});
  write_atomically(arguments.output, text);
  return kDone;
}

}  // namespace

void add_new(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<NewArguments>();
  CLI::App* command = app.add_subcommand("new", "Print a commented example recipe");
  command->add_option("TEMPLATE", arguments->name, "Which one; see --list")->type_name("");
  command->add_option("-o,--output", arguments->output, "Write it to a file instead")
      ->type_name("FILE.toml");
  command->add_flag("--list", arguments->list, "List the templates");
  command->footer("Example: packstone new fibers -o fibers.toml");
  command->callback([arguments, &exit_code] { exit_code = run_new(*arguments); });
}

}  // namespace packstone::cli
