// packstone: random microstructures from the command line. Parses, calls, prints.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "libraries.hpp"
#include "packstone/core/error.hpp"
#include "recipe/nearest_key.hpp"

namespace {

namespace cli = packstone::cli;

// Where the descriptions of options begin in --help [columns].
constexpr std::size_t kHelpColumn = 27;

void complain(const std::exception& error) {
  std::fprintf(stderr, "packstone: %s\n", error.what());
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

std::string near_word(const std::string& word, const std::vector<std::string>& known) {
  const auto near = packstone::recipe::nearest_key(word, {known.begin(), known.end()});
  return near ? "; did you mean " + std::string(*near) + "?" : "";
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// What is wrong with the words of the command line, with advice.
std::string usage_problem(const CLI::App& app, const CLI::ParseError& error, int argc,
                          char** argv) {
  if (app.get_subcommands().empty()) {
    const std::vector<std::string> names = command_names(app);
    const std::string listed = fmt::format("{}", fmt::join(names, ", "));
    if (argc < 2) return "a command is missing; commands: " + listed;
    return std::string(argv[1]) + " is no command" + near_word(argv[1], names) +
           "\n  commands: " + listed;
  }
  const CLI::App& command = *app.get_subcommands().front();
  const std::vector<std::string> names = option_names(command);
  for (int i = 2; i < argc && dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--")) continue;
    if (std::find(names.begin(), names.end(), word) != names.end()) continue;
    return word + " is no option of " + command.get_name() + near_word(word, names);
  }
  return error.what();
}

int run(int argc, char** argv) {
  int exit_code = cli::kDone;
  CLI::App app("Random microstructures: certified packings of convex inclusions.");
  app.name("packstone");
  const auto formatter = std::make_shared<CLI::Formatter>();
  formatter->column_width(kHelpColumn);
  formatter->label("REQUIRED", "");
  app.formatter(formatter);
  app.set_version_flag("--version", cli::version_text());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 1 an honest no (check failed, target not reached);\n"
      "2 bad input or usage; 130 interrupted, best valid state kept.\n\n"
      "Example: packstone new fibers -o fibers.toml && packstone pack fibers.toml");
  cli::add_new(app, exit_code);
  cli::add_pack(app, exit_code);
  cli::add_relax(app, exit_code);
  cli::add_check(app, exit_code);
  cli::add_measure(app, exit_code);
  cli::add_draw(app, exit_code);
  cli::add_tessellate(app, exit_code);
  cli::add_export(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    const auto chosen = app.get_subcommands();
    std::fprintf(stderr, "packstone: %s\n  see packstone%s%s --help\n",
                 usage_problem(app, error, argc, argv).c_str(), chosen.empty() ? "" : " ",
                 chosen.empty() ? "" : chosen.front()->get_name().c_str());
    return cli::kBadInput;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const packstone::InvalidArgument& error) {
    complain(error);
    return cli::kBadInput;
  } catch (const packstone::FileError& error) {
    complain(error);
    return cli::kBadInput;
  } catch (const std::exception& error) {
    complain(error);
    return cli::kHonestNo;
  }
}
