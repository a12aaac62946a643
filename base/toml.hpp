// SPDX-License-Identifier: MIT
// Includes toml++; no other header does.
#pragma once

// Version 3.3 asserts conditions that a malformed file can break ("[[["), before it reports the error itself; bad input
// must not stop a debug build, so its assertions are off everywhere.
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>
