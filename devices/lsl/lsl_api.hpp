// SPDX-License-Identifier: MIT
// Lab Streaming Layer as far as Burin uses it: the functions of liblsl, found when the program runs, and the numbers
// that go with them. Nothing of it is needed to build.
//
// Signatures, numbers and what is said of them are those of lsl_c.h and lsl/*.h of version 1.17 (public in
// github.com/sccn/liblsl, include/). The functions throw nothing: a handle is null and a number is not 0 where one has
// failed. Stamps are seconds on the library's clock, lsl_local_clock(). A stamp of 0 means "now" there and
// one of -1 "deduce it". Any thread; one outlet or inlet is one thread's at a time.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "devices/presence/device_presence.hpp"

namespace burin::devices {

// Handles: lsl_streaminfo, lsl_outlet, lsl_inlet, lsl_xml_ptr and lsl_continuous_resolver. No types of their own, since
// a sanitizer that compares a function's type with its pointer's goes by their names.
using LslInfo = void*;
using LslOutlet = void*;
using LslInlet = void*;
using LslXml = void*;
using LslResolver = void*;

// lsl_channel_format_t, four bytes wide.
namespace LslFormat {
inline constexpr std::int32_t float32 = 1, string = 3;
}
// lsl_error_code_t.
inline constexpr std::int32_t kLslNoError = 0, kLslTimeout = -1, kLslLost = -2, kLslArgument = -3, kLslInternal = -4;
inline constexpr double kLslIrregularRate = 0.0;

struct LslApi {
    std::string library;  // as it was loaded
    std::int32_t (*protocol_version)() = nullptr;
    std::int32_t (*library_version)() = nullptr;
    const char* (*last_error)() = nullptr;  // null: the library is of before there was one
    double (*local_clock)() = nullptr;
    void (*destroy_string)(char*) = nullptr;

    LslInfo (*create_info)(const char* name, const char* type, std::int32_t channels, double rate_Hz,
                           std::int32_t format, const char* source_id) = nullptr;
    void (*destroy_info)(LslInfo) = nullptr;
    const char* (*name_of)(LslInfo) = nullptr;
    const char* (*source_id_of)(LslInfo) = nullptr;
    const char* (*uid_of)(LslInfo) = nullptr;
    std::int32_t (*channels_of)(LslInfo) = nullptr;
    LslXml (*description_of)(LslInfo) = nullptr;
    LslXml (*append_child)(LslXml, const char* name) = nullptr;
    LslXml (*append_child_value)(LslXml, const char* name, const char* value) = nullptr;

    // chunk_size 0: each push is a chunk; most_buffered: seconds, or hundreds of samples where the rate is irregular.
    LslOutlet (*create_outlet)(LslInfo, std::int32_t chunk_size, std::int32_t most_buffered) = nullptr;
    void (*destroy_outlet)(LslOutlet) = nullptr;
    // elements: values, a multiple of the number of channels; a stamp for each sample.
    std::int32_t (*push_floats)(LslOutlet, const float* values, unsigned long elements, const double* stamps_s,
                                std::int32_t push_through) = nullptr;
    std::int32_t (*push_text)(LslOutlet, const char** texts, double stamp_s, std::int32_t push_through) = nullptr;

    LslResolver (*create_resolver)(const char* predicate, double forget_after_s) = nullptr;
    // Returns how many it has written, or an error below 0. Each is to be destroyed.
    std::int32_t (*resolved)(LslResolver, LslInfo* to, std::uint32_t room) = nullptr;
    void (*destroy_resolver)(LslResolver) = nullptr;
    LslInlet (*create_inlet)(LslInfo, std::int32_t most_buffered, std::int32_t chunk, std::int32_t recovers) = nullptr;
    void (*destroy_inlet)(LslInlet) = nullptr;
    void (*open_stream)(LslInlet, double timeout_s, std::int32_t* error) = nullptr;
    // Returns what is to be added to a stamp of the stream to have it on this machine's lsl_local_clock().
    double (*time_correction)(LslInlet, double timeout_s, std::int32_t* error) = nullptr;
    // Returns the stamp; 0: nothing came in time. Each text is to be destroyed by destroy_string().
    double (*pull_text)(LslInlet, char** texts, std::int32_t channels, double timeout_s, std::int32_t* error) = nullptr;

    // Returns why the last call failed, for people.
    [[nodiscard]] std::string why() const;
    // Returns "1.17" of a library 1.17.
    [[nodiscard]] std::string version() const;
};

// Names the library's file; empty or not set: the system's loader finds liblsl.so.2 or liblsl.so.
inline constexpr const char* kLslPathVariable = "BURIN_LIBLSL";

// Loads the library; it stays loaded. An Error names the library, what is wrong with it (it is not there, lacks a
// function, speaks another protocol than 1.x), where it can be had and the variable.
[[nodiscard]] Result<LslApi> load_lsl_api();
[[nodiscard]] Result<LslApi> load_lsl_api(const std::string& library);
// Looks whether it can be loaded.
[[nodiscard]] DevicePresence look_for_lsl();

}  // namespace burin::devices
