// SPDX-License-Identifier: MIT
#include "base/json.hpp"

// The one instantiation that json.hpp promises.
template class nlohmann::basic_json<nlohmann::ordered_map>;
