// SPDX-License-Identifier: MIT
// The HIL API, Quanser's interface to its data acquisition cards, as far as Burin uses it: its functions, found in the
// maker's library when the program runs. Nothing of it is needed to build.
//
// Signatures are those of hil.h, quanser_version.h and quanser_messages.h (public copies beside QuanserBindings.jl and
// in Mahi's DAQ library). Errors are negative. A boolean is a char. Volts; counts of encoders.
// The watchdog, as hil.h has it: when it expires, a card of the Q8 series takes its analog outputs to 0 V only where
// its digital outputs are told to go tristate, and the other way round; with neither, all outputs stay as they are.
// Both are told before it is started. One that has expired refuses all access until it is cleared, which brings back
// what was before; neither stopping it nor opening the card anew clears it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/error.hpp"

namespace burin::devices {

using HilCard = void*;
using HilError = int;
using HilDigitalState = int;  // an enumeration of C

inline constexpr HilDigitalState kHilTristate = 2;

struct HilVersion {
    std::uint32_t size = sizeof(HilVersion);
    std::uint16_t major = 0, minor = 0, release = 0, build = 0;
};
static_assert(sizeof(HilVersion) == 12);

struct HilApi {
    HilError (*version)(HilVersion*) = nullptr;
    HilError (*open)(const char* type, const char* identifier, HilCard*) = nullptr;
    HilError (*close)(HilCard) = nullptr;
    HilError (*set_encoder_counts)(HilCard, const std::uint32_t*, std::uint32_t, const std::int32_t*) = nullptr;
    HilError (*set_digital_directions)(HilCard, const std::uint32_t* inputs, std::uint32_t,
                                       const std::uint32_t* outputs, std::uint32_t) = nullptr;
    HilError (*read_encoder)(HilCard, const std::uint32_t*, std::uint32_t, std::int32_t*) = nullptr;
    HilError (*write_analog)(HilCard, const std::uint32_t*, std::uint32_t, const double*) = nullptr;
    HilError (*write_digital)(HilCard, const std::uint32_t*, std::uint32_t, const char*) = nullptr;
    HilError (*watchdog_analog)(HilCard, const std::uint32_t*, std::uint32_t, const double*) = nullptr;
    HilError (*watchdog_digital)(HilCard, const std::uint32_t*, std::uint32_t, const HilDigitalState*) = nullptr;
    HilError (*watchdog_start)(HilCard, double timeout_s) = nullptr;
    HilError (*watchdog_reload)(HilCard) = nullptr;  // 0: it had expired
    HilError (*watchdog_clear)(HilCard) = nullptr;
    HilError (*watchdog_stop)(HilCard) = nullptr;
    // Of another library of the maker's, which this one loads; null: errors have numbers alone.
    HilError (*error_text)(const char* locale, HilError, char*, std::size_t) = nullptr;
};

inline constexpr const char* kHilLibrary = "libhil.so";
inline constexpr const char* kHilFolder = "/opt/quanser/lib/";  // where the maker puts it

// Loads the library, which stays loaded. An Error says that there is none, or which function it lacks, or that it is
// older than version 2.
[[nodiscard]] Result<HilApi> load_hil_api(const std::string& library);
// Returns what an error of the library is in its words, with its number.
[[nodiscard]] std::string hil_error_text(const HilApi& api, HilError error);

}  // namespace burin::devices
