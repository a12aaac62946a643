// SPDX-License-Identifier: MIT
// An allocation that nobody can read by looking at it: each place's group is enciphered with a key, and opened by
// itself when a participant takes the place.
//
// A line for each place: "STRATUM POSITION SEALED DIGEST". SEALED is 64 bytes in hexadecimal, the block's number and
// the group's code padded with spaces, added bit by bit to SHA-256(key, stratum, position, 1) and (.., 2); DIGEST is
// SHA-256(key, stratum, position, block and group), so that a wrong key and a changed line are found. Whoever has the
// key and this program can open every place; docs/study.md says what that means. Pure; any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "study/assign/allocation.hpp"

namespace burin::study {

// Lists: one for each combination of codes, in their order. The key is any text that nobody guesses.
[[nodiscard]] std::string seal_allocation(const Protocol& protocol,
                                          const std::vector<std::vector<AllocationPlace>>& lists,
                                          const std::string& key);

// The place of a stratum's list, from 1. Fails where the list has no such place, with what it has; where the key is
// another; and where the line was changed.
[[nodiscard]] Result<AllocationPlace> open_place(std::string_view sealed, const Protocol& protocol,
                                                 const std::string& key, const std::string& stratum,
                                                 std::size_t position);

// How many places a stratum's list has.
[[nodiscard]] std::size_t places_in(std::string_view sealed, const std::string& stratum);

}  // namespace burin::study
