// SPDX-License-Identifier: MIT
// How many random cases a property is tried with, and from which seed: decided here for every test program.
//
// Without anything in the environment the cases are the same at every run, so that a failure of continuous integration
// is found again. Under the address and thread sanitizers, where a case costs ten times as much, there are 100 of them.
//   BURIN_TEST_SEED=N    other cases; what the soak run does (scripts/test --soak)
//   BURIN_TEST_CASES=N   so many; from 5000 on it is the soak run, which alone has time for all costly cases
//   RC_PARAMS=...        for rapidcheck's properties only: replaces both, as rapidcheck prints it with a failure
#pragma once

#include <cstdint>

namespace burin::test {

struct PropertyCases {
    std::uint64_t seed = 20;
    std::uint64_t count = 1000;
};

[[nodiscard]] PropertyCases property_cases();

// Returns how many cases to try of a property whose cases are so costly that only the soak run has time for `all` of
// them: a tenth of them in an ordinary run, a hundredth under sanitizers, but one at least.
[[nodiscard]] int costly_cases(int all);

// Tells rapidcheck, which reads its settings from the environment when the first property runs.
void set_up_properties();

}  // namespace burin::test
