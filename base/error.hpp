// SPDX-License-Identifier: MIT
// The three kinds of error, never mixed (docs/architecture.md):
//   a broken contract      -> BURIN_CHECK: stops a debug build, is counted in a release build;
//   an expected failure    -> Result<T>: file, device, GPU, network; says what, where and what to do;
//   a degraded tick        -> a flag in the tick record (haptics/), never an error value.
// Result and Error allocate: they are not for the haptic thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <expected>
#include <string>

namespace burin {

// An expected failure. Printed as one line: "where: what; remedy".
struct Error {
    std::string what;    // what went wrong, e.g. "12 edges have only one triangle"
    std::string where;   // the file, device or setting concerned, e.g. "bunny.obj:17"
    std::string remedy;  // what the user can do, e.g. "close the mesh or pass --close-holes"

    [[nodiscard]] std::string line() const {
        std::string text = where.empty() ? what : where + ": " + what;
        if (!remedy.empty()) text += "; " + remedy;
        return text;
    }
};

template <typename T>
using Result = std::expected<T, Error>;

[[nodiscard]] inline std::unexpected<Error> fail(std::string where, std::string what, std::string remedy = {}) {
    return std::unexpected(Error{std::move(what), std::move(where), std::move(remedy)});
}

// Called by BURIN_CHECK. Wait-free; usable on any thread.
void contract_broken(const char* expression, const char* file, int line) noexcept;

// Returns the number of contracts broken since the start of the process. Tests assert that it stays 0.
[[nodiscard]] std::uint64_t broken_contracts() noexcept;

}  // namespace burin

// Checks a contract between functions of this program; never for input from outside.
#define BURIN_CHECK(expression) \
    ((expression) ? static_cast<void>(0) : ::burin::contract_broken(#expression, __FILE__, __LINE__))
