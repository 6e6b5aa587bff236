#pragma once

/// @file
/// Overloaded: one visitor from several lambdas.

namespace packstone {

/// For std::visit: `std::visit(Overloaded{[](const Sphere& s) {...}, ...}, body)`.
template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};

// Clang before 17 does not deduce the arguments of an aggregate by itself.
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

}  // namespace packstone
