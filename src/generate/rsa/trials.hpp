#pragma once

/// @file
/// Numbered trials, evaluated by any number of threads: the lowest one accepted wins.

#include <algorithm>
#include <array>
#include <cstdint>

#include "packstone/core/parallel.hpp"
#include "packstone/core/run_context.hpp"

namespace packstone::rsa {

/// How a row of trials ended.
struct TrialRun {
  std::int64_t accepted = -1;  ///< Number of the trial that was accepted; -1: none.
  std::int64_t tried = 0;      ///< Trials up to the accepted one, or all.
  std::int64_t cost = 0;       ///< Sum of their costs.
  StopRequest stop = StopRequest::none;
};

/// Trials between two looks at the budget.
constexpr std::int64_t kTrialsPerBlock = 64;

/// Evaluates trials first, first + 1, ... until one is accepted, `end` is reached, their cost
/// exceeds `budget` (looked at after every block of trials), or `run` asks to stop.
///
/// @param trial  trial(k, cost) says whether trial k is accepted and adds its cost. Called from
///               several threads, and maybe for some trials beyond the one that wins.
template <class Trial>
TrialRun run_trials(std::int64_t first, std::int64_t end, std::int64_t budget,
                    const RunContext& run, const Trial& trial) {
  constexpr std::int64_t block_size = kTrialsPerBlock;
  constexpr std::int64_t blocks_alone = 16;  // Before threads are worth waking.
  constexpr std::size_t blocks_at_once = 128;

  struct Block {
    std::int64_t accepted, tried, cost;
  };
  const auto evaluate = [&](std::int64_t begin) {
    Block block{-1, 0, 0};
    const std::int64_t last = std::min(end, begin + block_size);
    for (std::int64_t k = begin; k < last && block.accepted < 0; ++k) {
      if (trial(k, block.cost)) block.accepted = k;
      ++block.tried;
    }
    return block;
  };

  TrialRun total;
  // True: the row ends with this block.
  const auto count = [&](const Block& block) {
    total.tried += block.tried;
    total.cost += block.cost;
    total.accepted = block.accepted;
    return block.accepted >= 0 || total.cost > budget || first + total.tried >= end;
  };

  for (std::int64_t blocks = 0; first + total.tried < end;) {
    if (run.threads() == 1 || blocks < blocks_alone) {
      if (count(evaluate(first + total.tried))) return total;
      ++blocks;
    } else {
      std::array<Block, blocks_at_once> found;
      const std::int64_t begin = first + total.tried;
      parallel_for(static_cast<std::int64_t>(blocks_at_once), run.threads(), 4,
                   [&](std::int64_t from, std::int64_t to) {
                     for (std::int64_t b = from; b < to; ++b) {
                       found[static_cast<std::size_t>(b)] = evaluate(begin + b * block_size);
                     }
                   });
      for (const Block& block : found) {
        if (count(block)) return total;
      }
      blocks += static_cast<std::int64_t>(blocks_at_once);
    }
    if (blocks % 16 == 0) {
      total.stop = run.stop_request();
      if (total.stop != StopRequest::none) return total;
    }
  }
  return total;
}

}  // namespace packstone::rsa
