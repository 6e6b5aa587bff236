#pragma once

/// @file
/// The curves of contact of one body about all others, made when first asked for.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "generate/published_advancing_layer/multi_circle.hpp"

namespace packstone::published_layer {

/// They depend on the shapes alone, so that one serves wherever the two are near each other.
class ContactCurves {
 public:
  explicit ContactCurves(double contact_gap) : contact_gap_(contact_gap) {}

  /// From now on of this body, which must stay where it is.
  void begin(const MultiCircle& moving) {
    moving_ = &moving;
    used_ = 0;
    ++round_;
  }

  /// About body `id`, of shape `fixed`. Valid until begin().
  [[nodiscard]] const std::vector<ContactArc>& about(std::int32_t id, const MultiCircle& fixed) {
    const auto k = static_cast<std::size_t>(id);
    if (k >= slots_.size()) slots_.resize(2 * k + 64);
    Slot& slot = slots_[k];
    if (slot.round != round_) {
      slot = {round_, used_++};
      if (slot.index == curves_.size()) curves_.emplace_back();
      contact_arcs(fixed, *moving_, contact_gap_, curves_[slot.index]);
    }
    return curves_[slot.index];
  }

  [[nodiscard]] const MultiCircle& moving() const { return *moving_; }

 private:
  struct Slot {
    std::int64_t round = 0;
    std::size_t index = 0;
  };

  double contact_gap_;
  const MultiCircle* moving_ = nullptr;
  std::int64_t round_ = 0;
  std::vector<Slot> slots_;  // By body.
  std::size_t used_ = 0;
  std::deque<std::vector<ContactArc>> curves_;
};

}  // namespace packstone::published_layer
