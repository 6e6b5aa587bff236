#include "commands.hpp"

namespace packstone::cli {

void add_packing(CLI::App& command, std::string& path) {
  command.add_option("PACKING", path, "Packing (.json, .h5)")->type_name("")->required();
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads; the result is the same [all]")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
}

}  // namespace packstone::cli
