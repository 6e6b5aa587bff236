#pragma once

/// @file
/// Overloaded: one visitor from several lambdas.

namespace packstone {

/// For std::visit: `std::visit(Overloaded{[](const Sphere& s) {...}, ...}, body)`.
template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};

}  // namespace packstone
