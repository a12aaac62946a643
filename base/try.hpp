// SPDX-License-Identifier: MIT
// Hands an error on to the caller, as `?` does in other languages: for functions that return a Result and have nothing
// to add to the error of one that they call.
//
//   BURIN_TRY(log, read_input_log(path));   // `log` is the value of type InputLog&, or the function has returned
//   BURIN_TRY_DO(outputs.prepare(log));     // of a Result<void>, or one whose value nobody wants
//
// The value lives as long as a local variable declared in its place, whether or not it is used: a folder that goes away
// with it stays until the block's end. BURIN_TRY declares, so it stands in a block of its own, not behind an `if`
// without braces. Any thread; no cost beside the branch.
#pragma once

#include <expected>
#include <utility>

#define BURIN_TRY(name, ...)                                                                        \
    auto name##_or_error = (__VA_ARGS__);                                                           \
    if (!(name##_or_error).has_value()) return std::unexpected(std::move(name##_or_error).error()); \
    [[maybe_unused]] auto& name = *(name##_or_error)

#define BURIN_TRY_DO(...)                                                   \
    do {                                                                    \
        if (auto burin_checked = (__VA_ARGS__); !burin_checked.has_value()) \
            return std::unexpected(std::move(burin_checked).error());       \
    } while (false)
