#include <filesystem>
#include <memory>
#include <string>

#include "commands.hpp"
#include "output_file.hpp"
#include "packstone/core/error.hpp"
#include "packstone/io/export_packing.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone::cli {
namespace {

struct ExportArguments {
  std::string packing;
  std::string output;
  ExportOptions options;
};

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand("export", "Write a packing for other programs");
  add_packing(*command, arguments->packing);
  command->add_option("-o,--output", arguments->output, "By ending: VTK surfaces, STL, table")
      ->type_name("FILE.vtu|.stl|.csv")
      ->required();
  command
      ->add_option("--segments", arguments->options.segments, "Segments around a full circle [32]")
      ->type_name("N")
      ->check(CLI::Range(8, 4096).description(""));
  command->add_flag("--images", arguments->options.images,
                    "Also the periodic images that reach into the cell;\n"
                    "tables then name the faces that each cuts");
  command
      ->add_option("--balls", arguments->options.ball_spacing,
                   "Table of the balls in each body: distance\nof the first two, 0.01 to 1")
      ->type_name("S");
  command->footer("Example: packstone export fibers.json -o fibers.vtu");
  command->callback([arguments, &exit_code] {
    check_output_file(arguments->output, {".vtu", ".stl", ".csv"});
    const Packing packing = read_packing(arguments->packing);
    if (packing.cell.dimension == 2 &&
        std::filesystem::path(arguments->output).extension() == ".stl") {
      throw InvalidArgument("-o " + arguments->output + ": STL holds 3D surfaces, and " +
                            arguments->packing + " is a packing in the plane; write .vtu or .csv");
    }
    export_packing(arguments->output, packing, arguments->options);
    exit_code = kDone;
  });
}

}  // namespace packstone::cli
