// packstone: random microstructures from the command line. Parses, calls, prints.

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "commands.hpp"
#include "libraries.hpp"
#include "packstone/core/error.hpp"

namespace {

using namespace packstone;

// Where the descriptions of options begin in --help [columns].
constexpr std::size_t kHelpColumn = 27;

void complain(const std::exception& error) {
  std::fprintf(stderr, "packstone: %s\n", error.what());
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
  cli::add_check(app, exit_code);
  cli::add_draw(app, exit_code);
  cli::add_export(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::kDone : cli::kBadInput;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const InvalidArgument& error) {
    complain(error);
    return cli::kBadInput;
  } catch (const FileError& error) {
    complain(error);
    return cli::kBadInput;
  } catch (const std::exception& error) {
    complain(error);
    return cli::kHonestNo;
  }
}
