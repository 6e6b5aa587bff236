#pragma once

/// @file
/// The words of `[packing]` and the values that they stand for, to read and to write by.

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "packstone/recipe/recipe.hpp"

namespace packstone::recipe {

template <class T>
using Words = std::vector<std::pair<std::string_view, T>>;

inline const Words<PackMethod> kMethods{
    {"auto", PackMethod::automatic},
    {"rsa", PackMethod::rsa},
    {"event-driven", PackMethod::event_driven},
    {"relaxation", PackMethod::relaxation},
    {"time-driven", PackMethod::time_driven},
    {"advancing-layer", PackMethod::advancing_layer},
    {"drop-and-roll", PackMethod::drop_and_roll},
    {"published-advancing-layer", PackMethod::published_advancing_layer}};

inline const Words<RsaOrder> kRsaOrders{{"largest-first", RsaOrder::largest_first},
                                        {"group", RsaOrder::as_given},
                                        {"shuffled", RsaOrder::shuffled}};

inline const Words<EventDrivenGoal> kGoals{{"target", EventDrivenGoal::target},
                                           {"densest", EventDrivenGoal::densest},
                                           {"equilibrium", EventDrivenGoal::equilibrium}};

inline const Words<GrowthStart> kGrowthStarts{{"points", GrowthStart::points},
                                              {"rsa", GrowthStart::rsa}};

inline const Words<RelaxationGoal> kRelaxationGoals{{"target", RelaxationGoal::target},
                                                    {"densest", RelaxationGoal::densest}};

inline const Words<RelaxationTurn> kRelaxationTurns{{"hold-tensor", RelaxationTurn::hold_tensor},
                                                    {"free", RelaxationTurn::free},
                                                    {"locked", RelaxationTurn::locked}};

inline const Words<RelaxationFrom> kRelaxationStarts{{"rsa", RelaxationFrom::rsa},
                                                     {"random", RelaxationFrom::random}};

inline const Words<TimeDrivenIntegrator> kIntegrators{
    {"velocity-verlet", TimeDrivenIntegrator::velocity_verlet},
    {"leapfrog", TimeDrivenIntegrator::leapfrog}};

/// The word for `value`, which is one of the list.
template <class T>
std::string_view word_for(const Words<T>& words, T value) {
  return std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.second == value; })
      ->first;
}

}  // namespace packstone::recipe
