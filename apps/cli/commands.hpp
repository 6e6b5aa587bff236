#pragma once

/// @file
/// The commands of the program. Each adds itself to the command line and, when it is chosen, sets
/// the exit code.

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "packstone/core/run_context.hpp"
#include "packstone/io/draw.hpp"
#include "progress_printer.hpp"

namespace packstone::cli {

/// What the program ends with.
enum ExitCode {
  kDone = 0,
  kHonestNo = 1,       ///< The check failed, the target was not reached, a file was not written.
  kBadInput = 2,       ///< Bad input or usage.
  kInterrupted = 130,  ///< Interrupted; the best valid state was kept.
};

/// The argument and the options that several commands share.
void add_packing(CLI::App& command, std::string& path);
void add_threads(CLI::App& command, int& threads);
void add_time_limit(CLI::App& command, std::string& limit);
void add_min_gap(CLI::App& command, double& gap);
/// What the colors of a picture say; a word of color_words().
void add_color(CLI::App& command, std::string& color);
[[nodiscard]] const std::map<std::string, ColorBy>& color_words();

/// Refuse what is no finite number >= 0, or > 0.
[[nodiscard]] CLI::Validator number_at_least_zero();
[[nodiscard]] CLI::Validator number_above_zero();

/// What long work of a command runs under: Ctrl-C, threads, the time limit (none where the text is
/// empty) and, unless `quiet`, progress by `printer`, which outlives it.
[[nodiscard]] RunContext run_context(int threads, const std::string& time_limit, bool quiet,
                                     ProgressPrinter& printer);

void add_pack(CLI::App& app, int& exit_code);
void add_relax(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_measure(CLI::App& app, int& exit_code);
void add_draw(CLI::App& app, int& exit_code);
void add_tessellate(CLI::App& app, int& exit_code);
void add_export(CLI::App& app, int& exit_code);
void add_new(CLI::App& app, int& exit_code);

}  // namespace packstone::cli
