// SPDX-License-Identifier: MIT
#include "tests/support/property_cases.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace burin::test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kCases = 100;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr std::uint64_t kCases = 100;
#else
constexpr std::uint64_t kCases = 1000;
#endif
#else
constexpr std::uint64_t kCases = 1000;
#endif

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr && *text != '\0' ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace

PropertyCases property_cases() {
    return {.seed = from_environment("BURIN_TEST_SEED", PropertyCases{}.seed),
            .count = from_environment("BURIN_TEST_CASES", kCases)};
}

int costly_cases(int all) {
    constexpr std::uint64_t kSoak = 5000, kWhole = 10'000;
    const std::uint64_t count = property_cases().count, of = static_cast<std::uint64_t>(all);
    return static_cast<int>(count >= kSoak ? of : std::max<std::uint64_t>(1, of * count / kWhole));
}

void set_up_properties() {
    const PropertyCases cases = property_cases();
    const std::string parameters = "seed=" + std::to_string(cases.seed) + " max_success=" + std::to_string(cases.count);
    setenv("RC_PARAMS", parameters.c_str(), 0);  // whoever set it knows better
}

}  // namespace burin::test
