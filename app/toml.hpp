// SPDX-License-Identifier: MIT
// toml++, included from here alone. Its 3.3 asserts what a malformed file can break ("[[["), before it reports the error
// itself; bad input must not stop a debug build, so its assertions are off everywhere.
#pragma once

#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>
