#include <cstdio>
#include <packstone/packstone.hpp>

int main() {
  const packstone::Cell cell;
  const packstone::RsaResult run = packstone::rsa_saturate(cell, 0.2, {.seed = 3});
  const packstone::Certificate verdict = packstone::check_packing(run.packing);
  std::printf("%zu spheres, fraction %.4f\n", run.packing.inclusions.size(), verdict.fraction);
  return verdict.passed() ? 0 : 1;
}
