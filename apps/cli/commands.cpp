#include "commands.hpp"

#include <cmath>

#include "interrupt.hpp"
#include "packstone/recipe/recipe.hpp"

namespace packstone::cli {
namespace {

std::string check_time(const std::string& text) {
  return seconds_in(text)
             ? ""
             : text + "; allowed is a time > 0 such as \"30 s\", \"10 min\", \"1.5 h\"";
}

std::string check_number(const std::string& text, bool zero_is_allowed) {
  double x = 0.0;
  const bool number = CLI::detail::lexical_cast(text, x) && std::isfinite(x);
  if (number && (x > 0.0 || (x == 0.0 && zero_is_allowed))) return "";
  return text + "; allowed is a number " + (zero_is_allowed ? ">= 0" : "> 0");
}

std::string check_color(const std::string& word) {
  return color_words().count(word) != 0 ? "" : word + "; allowed is group, size or orientation";
}

}  // namespace

const std::map<std::string, ColorBy>& color_words() {
  static const std::map<std::string, ColorBy> words{
      {"group", ColorBy::group}, {"size", ColorBy::size}, {"orientation", ColorBy::orientation}};
  return words;
}

void add_color(CLI::App& command, std::string& color) {
  command.add_option("--color-by", color, "group [default], size or orientation")
      ->check(CLI::Validator(check_color, ""))
      ->type_name("WHAT");
}

void add_packing(CLI::App& command, std::string& path) {
  command.add_option("PACKING", path, "Packing (.json, .h5)")->type_name("")->required();
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads; the result is the same [all]")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
}

void add_time_limit(CLI::App& command, std::string& limit) {
  command.add_option("--time-limit", limit, "Then keep what is valid: \"30 s\", \"10 min\"")
      ->type_name("TIME")
      ->check(CLI::Validator(check_time, ""));
}

void add_min_gap(CLI::App& command, double& gap) {
  command.add_option("--min-gap", gap, "Least gap between any two [0]")
      ->type_name("G")
      ->check(number_at_least_zero());
}

CLI::Validator number_at_least_zero() {
  return {[](const std::string& text) { return check_number(text, true); }, ""};
}

CLI::Validator number_above_zero() {
  return {[](const std::string& text) { return check_number(text, false); }, ""};
}

RunContext run_context(int threads, const std::string& time_limit, bool quiet,
                       ProgressPrinter& printer) {
  RunContext run;
  run.cancel_flag(&interrupt_flag()).threads(threads);
  if (const auto limit = seconds_in(time_limit)) run.time_limit(*limit);
  if (!quiet) run.on_progress([&printer](const Progress& progress) { printer.print(progress); });
  return run;
}

}  // namespace packstone::cli
