#include <cmath>
#include <memory>
#include <string>

#include "commands.hpp"
#include "output_file.hpp"
#include "packstone/io/draw.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone::cli {
namespace {

struct DrawArguments {
  std::string packing;
  std::string output;
  DrawOptions options;
  std::string color = "group";
  int threads = 0;
};

CLI::Validator degrees_within(int most) {
  const auto check = [most](const std::string& text) {
    double degrees = 0.0;
    if (CLI::detail::lexical_cast(text, degrees) && std::abs(degrees) <= most) return std::string();
    return text + "; allowed is -" + std::to_string(most) + " to " + std::to_string(most);
  };
  return CLI::Validator(check, "");
}

void add_look(CLI::App& command, DrawOptions& options, std::string& color) {
  add_color(command, color);
  command.add_flag("--cut", options.cut, "Cut bodies at the faces of the cell");
  command.add_option("--azimuth", options.azimuth, "Turn of the camera about z [35]")
      ->type_name("DEGREES")
      ->check(degrees_within(360));
  command.add_option("--elevation", options.elevation, "Its height above the horizon [25]")
      ->type_name("DEGREES")
      ->check(degrees_within(89));
  command.add_option("--samples", options.samples, "Rays per pixel = N x N, 1 to 32 [4]")
      ->type_name("N")
      ->check(CLI::Range(1, 32).description(""));
}

}  // namespace

void add_draw(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<DrawArguments>();
  CLI::App* command = app.add_subcommand("draw", "Draw a packing, without a display");
  add_packing(*command, arguments->packing);
  command->add_option("-o,--output", arguments->output, "Picture to write; .svg in 2D")
      ->type_name("FILE.png|.svg")
      ->required();
  command->add_option("--width", arguments->options.width, "Pixels, 16 to 16384 [1200]")
      ->type_name("N")
      ->check(CLI::Range(16, 16384).description(""));
  command->add_option("--height", arguments->options.height, "Pixels, 16 to 16384 [1000]")
      ->type_name("N")
      ->check(CLI::Range(16, 16384).description(""));
  add_look(*command, arguments->options, arguments->color);
  add_threads(*command, arguments->threads);
  command->footer("Example: packstone draw fibers.json -o fibers.png --color-by orientation");
  command->callback([arguments, &exit_code] {
    check_output_file(arguments->output, {".png", ".svg"});
    arguments->options.color_by = color_words().at(arguments->color);
    draw_packing(arguments->output, read_packing(arguments->packing), arguments->options,
                 RunContext{}.threads(arguments->threads));
    exit_code = kDone;
  });
}

}  // namespace packstone::cli
