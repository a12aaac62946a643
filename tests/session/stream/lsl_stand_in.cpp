// SPDX-License-Identifier: MIT
#include "tests/session/stream/lsl_stand_in.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "tests/session/stream/xdf_file.hpp"

#ifndef BURIN_LSL_STAND_IN_PROTOCOL
#define BURIN_LSL_STAND_IN_PROTOCOL 110
#endif

namespace {

using burin::test::LslNode;
using burin::test::LslStandIn;
using burin::test::LslStream;

constexpr std::int32_t kFloat32 = 1, kString = 3;
constexpr std::int32_t kArgumentError = -3, kInternalError = -4, kLostError = -2, kTimeoutError = -1;

struct Outlet {
    std::shared_ptr<LslStream> stream;
    bool is_busy = false;
};

// These live until the process ends, whatever thread still waits in here then.
LslStandIn& stand_in() {
    static LslStandIn* const one = [] {
        auto* const made = new LslStandIn;
        made->blocks_pushes = std::getenv("BURIN_LSL_STAND_IN_BLOCKS") != nullptr;
        return made;
    }();
    return *one;
}
std::vector<LslStream*>& infos() {
    static auto* const all = new std::vector<LslStream*>;
    return *all;
}
std::vector<Outlet*>& outlets() {
    static auto* const all = new std::vector<Outlet*>;
    return *all;
}
std::vector<std::shared_ptr<LslStream>*>& inlets() {
    static auto* const all = new std::vector<std::shared_ptr<LslStream>*>;
    return *all;
}

template <typename Handle>
bool is_known(const std::vector<Handle*>& all, const void* handle) {
    return std::ranges::find(all, static_cast<const Handle*>(handle)) != all.end();
}

void note(const std::string& what) {
    stand_in().violations.push_back(what);
    stand_in().error = what;
}

double clock_s() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec) + stand_in().clock_offset_s;
}

LslStream* known_info(void* info) {
    if (is_known(infos(), info)) return static_cast<LslStream*>(info);
    note("a streaminfo that is none");
    return nullptr;
}

Outlet* known_outlet(void* outlet) {
    if (is_known(outlets(), outlet)) return static_cast<Outlet*>(outlet);
    note("an outlet that is none");
    return nullptr;
}

std::shared_ptr<LslStream> known_inlet(void* inlet) {
    if (is_known(inlets(), inlet)) return *static_cast<std::shared_ptr<LslStream>*>(inlet);
    note("an inlet that is none");
    return nullptr;
}

// Waits where pushes are blocked, and says whether this one is refused.
bool is_refused(std::unique_lock<std::mutex>& lock) {
    LslStandIn& s = stand_in();
    ++s.blocked;
    s.changed.notify_all();
    s.changed.wait(lock, [&] { return !s.blocks_pushes; });
    --s.blocked;
    s.changed.notify_all();
    if (s.refuses_pushes) s.error = "a push is refused";
    return s.refuses_pushes;
}

bool is_stamp(double stamp_s) { return std::isfinite(stamp_s) && stamp_s != 0.0 && stamp_s != -1.0; }

// What both kinds of push have in common. `store` keeps the samples, and says what is wrong with them.
template <typename Store>
std::int32_t push(void* handle, std::int32_t format, std::span<const double> stamps_s, const Store& store) {
    LslStandIn& s = stand_in();
    std::unique_lock lock(s.mutex);
    Outlet* const outlet = known_outlet(handle);
    if (outlet == nullptr) return kArgumentError;
    if (outlet->is_busy) note("two threads push into one outlet");
    if (outlet->stream->format != format) note("values of another format than the stream's");
    if (outlet->is_busy || outlet->stream->format != format) return kArgumentError;
    if (!std::ranges::all_of(stamps_s, is_stamp)) {
        note("a stamp that is none");
        return kArgumentError;
    }
    outlet->is_busy = true;
    const bool refused = is_refused(lock);
    outlet->is_busy = false;
    if (refused) return kInternalError;
    store(*outlet->stream);
    outlet->stream->stamps_s.insert(outlet->stream->stamps_s.end(), stamps_s.begin(), stamps_s.end());
    ++outlet->stream->pushes;
    s.changed.notify_all();
    return 0;
}

char* given_string(const std::string& text) {
    char* const copy = static_cast<char*>(std::malloc(text.size() + 1));
    std::memcpy(copy, text.c_str(), text.size() + 1);
    ++stand_in().strings;
    return copy;
}

// A marker of the stream that the environment asks for.
void add_asked_marker() {
    const char* const text = std::getenv("BURIN_LSL_STAND_IN_MARKER");
    if (text == nullptr || !stand_in().remotes.empty()) return;
    auto keyboard = std::make_shared<LslStream>();
    keyboard->name = "Keyboard";
    keyboard->type = "Markers";
    keyboard->uid = "uid of the keyboard";
    keyboard->channels = 1;
    keyboard->format = kString;
    keyboard->waiting.push_back({clock_s(), {text}});
    stand_in().remotes.push_back(keyboard);
}

bool is_meant(const LslStream& stream, const std::string& predicate) {
    if (stream.type != "Markers" || stream.is_lost) return false;
    return !predicate.contains("name=") || predicate.contains("name='" + stream.name + "'") ||
           predicate.contains("name=\"" + stream.name + "\"");
}

}  // namespace

extern "C" {

LslStandIn* burin_lsl_stand_in() { return &stand_in(); }

std::int32_t lsl_protocol_version() { return BURIN_LSL_STAND_IN_PROTOCOL; }
std::int32_t lsl_library_version() { return 117; }
const char* lsl_last_error() { return stand_in().error.c_str(); }

double lsl_local_clock() {
    const std::lock_guard lock(stand_in().mutex);
    return clock_s();
}

void lsl_destroy_string(char* text) {
    const std::lock_guard lock(stand_in().mutex);
    --stand_in().strings;
    std::free(text);
}

// ---- Streaminfo

void* lsl_create_streaminfo(const char* name, const char* type, std::int32_t channels, double rate_Hz,
                            std::int32_t format, const char* source_id) {
    const std::lock_guard lock(stand_in().mutex);
    if (name == nullptr || *name == 0 || type == nullptr || source_id == nullptr || channels < 1 || !(rate_Hz >= 0.0) ||
        format < 1 || format > 7) {
        note("a streaminfo of no name, no channels or no format");
        return nullptr;
    }
    auto* const info = new LslStream;
    info->name = name;
    info->type = type;
    info->source_id = source_id;
    info->channels = channels;
    info->rate_Hz = rate_Hz;
    info->format = format;
    infos().push_back(info);
    return info;
}

void lsl_destroy_streaminfo(void* info) {
    const std::lock_guard lock(stand_in().mutex);
    if (known_info(info) == nullptr) return;
    std::erase(infos(), static_cast<LslStream*>(info));
    delete static_cast<LslStream*>(info);
}

const char* lsl_get_name(void* info) {
    const std::lock_guard lock(stand_in().mutex);
    const LslStream* const known = known_info(info);
    return known != nullptr ? known->name.c_str() : "";
}
const char* lsl_get_source_id(void* info) {
    const std::lock_guard lock(stand_in().mutex);
    const LslStream* const known = known_info(info);
    return known != nullptr ? known->source_id.c_str() : "";
}
const char* lsl_get_uid(void* info) {
    const std::lock_guard lock(stand_in().mutex);
    const LslStream* const known = known_info(info);
    return known != nullptr ? known->uid.c_str() : "";
}
std::int32_t lsl_get_channel_count(void* info) {
    const std::lock_guard lock(stand_in().mutex);
    const LslStream* const known = known_info(info);
    return known != nullptr ? known->channels : 0;
}

void* lsl_get_desc(void* info) {
    const std::lock_guard lock(stand_in().mutex);
    const LslStream* const known = known_info(info);
    return known != nullptr ? known->description.get() : nullptr;
}
void* lsl_append_child(void* element, const char* name) {
    const std::lock_guard lock(stand_in().mutex);
    if (element == nullptr) {
        note("a child of no element");
        return nullptr;
    }
    auto& children = static_cast<LslNode*>(element)->children;
    children.push_back(std::make_unique<LslNode>(LslNode{name, "", {}}));
    return children.back().get();
}
void* lsl_append_child_value(void* element, const char* name, const char* value) {
    void* const child = lsl_append_child(element, name);
    const std::lock_guard lock(stand_in().mutex);
    if (child == nullptr) return nullptr;
    static_cast<LslNode*>(child)->text = value;
    for (const char* at = value; *at != 0; ++at)
        if (static_cast<unsigned char>(*at) < 0x20) note("a control character in a description");
    return element;
}

// ---- Outlets

void* lsl_create_outlet(void* info, std::int32_t chunk, std::int32_t most_buffered) {
    const std::lock_guard lock(stand_in().mutex);
    const LslStream* const known = known_info(info);
    if (known == nullptr || chunk < 0 || most_buffered < 0) return nullptr;
    if (stand_in().refuses_outlets) {
        stand_in().error = "no port is free";
        return nullptr;
    }
    auto stream = std::make_shared<LslStream>(*known);
    stream->uid = "uid " + std::to_string(stand_in().outlets.size());
    stream->is_open = true;
    stand_in().outlets.push_back(stream);
    outlets().push_back(new Outlet{std::move(stream)});
    return outlets().back();
}

void lsl_destroy_outlet(void* handle) {
    const std::lock_guard lock(stand_in().mutex);
    Outlet* const outlet = known_outlet(handle);
    if (outlet == nullptr) return;
    outlet->stream->is_open = false;
    std::erase(outlets(), outlet);
    delete outlet;
    stand_in().changed.notify_all();
    const char* const xdf = std::getenv("BURIN_LSL_STAND_IN_XDF");
    if (xdf != nullptr && outlets().empty()) burin::test::write_xdf(xdf, stand_in().outlets);
}

std::int32_t lsl_push_chunk_ftnp(void* outlet, const float* values, unsigned long elements, const double* stamps_s,
                                 std::int32_t) {
    std::size_t samples = 0;
    {
        const std::lock_guard lock(stand_in().mutex);
        const Outlet* const known = known_outlet(outlet);
        if (known == nullptr) return kArgumentError;
        const auto channels = static_cast<unsigned long>(known->stream->channels);
        if (values == nullptr || stamps_s == nullptr || elements % channels != 0) {
            note("a chunk that is no multiple of the channels");
            return kArgumentError;
        }
        samples = elements / channels;
    }
    return push(outlet, kFloat32, {stamps_s, samples},
                [&](LslStream& to) { to.values.insert(to.values.end(), values, values + elements); });
}

std::int32_t lsl_push_sample_strtp(void* outlet, const char** texts, double stamp_s, std::int32_t) {
    return push(outlet, kString, {&stamp_s, 1}, [&](LslStream& to) {
        for (std::int32_t i = 0; i < to.channels; ++i) to.texts.emplace_back(texts[i]);
    });
}

// ---- Inlets

void* lsl_create_continuous_resolver_bypred(const char* predicate, double) {
    const std::lock_guard lock(stand_in().mutex);
    const std::string asked = predicate;
    if (std::ranges::count(asked, '(') != std::ranges::count(asked, ')')) {
        stand_in().error = "the predicate is no XPath";
        return nullptr;
    }
    stand_in().predicate = asked;
    return &stand_in();
}

std::int32_t lsl_resolver_results(void* resolver, void** to, std::uint32_t room) {
    const std::lock_guard lock(stand_in().mutex);
    if (resolver != &stand_in()) return kArgumentError;
    add_asked_marker();
    std::uint32_t count = 0;
    // The streams of this process are seen as well.
    for (const auto* const all : {&stand_in().outlets, &stand_in().remotes})
        for (const auto& stream : *all) {
            if (count == room || !is_meant(*stream, stand_in().predicate)) continue;
            infos().push_back(new LslStream(*stream));
            to[count++] = infos().back();
        }
    return static_cast<std::int32_t>(count);
}

void lsl_destroy_continuous_resolver(void* resolver) {
    const std::lock_guard lock(stand_in().mutex);
    if (resolver != &stand_in()) note("a resolver that is none");
}

void* lsl_create_inlet(void* info, std::int32_t, std::int32_t, std::int32_t) {
    const std::lock_guard lock(stand_in().mutex);
    const LslStream* const known = known_info(info);
    if (known == nullptr) return nullptr;
    for (const auto* const all : {&stand_in().outlets, &stand_in().remotes})
        for (const auto& stream : *all) {
            if (stream->uid != known->uid) continue;
            ++stream->inlets;
            inlets().push_back(new std::shared_ptr<LslStream>(stream));
            return inlets().back();
        }
    return nullptr;
}

void lsl_destroy_inlet(void* inlet) {
    const std::lock_guard lock(stand_in().mutex);
    const auto stream = known_inlet(inlet);
    if (!stream) return;
    --stream->inlets;
    auto* const handle = static_cast<std::shared_ptr<LslStream>*>(inlet);
    std::erase(inlets(), handle);
    delete handle;
}

void lsl_open_stream(void* inlet, double, std::int32_t* error) {
    const std::lock_guard lock(stand_in().mutex);
    const auto stream = known_inlet(inlet);
    *error = !stream ? kArgumentError : stream->is_lost ? kLostError : 0;
}

double lsl_time_correction(void* inlet, double, std::int32_t* error) {
    const std::lock_guard lock(stand_in().mutex);
    const auto stream = known_inlet(inlet);
    *error = !stream ? kArgumentError : stream->is_lost ? kLostError : stream->has_correction ? 0 : kTimeoutError;
    return stream && *error == 0 ? stream->correction_s : 0.0;
}

// Does not wait: a test puts what comes.
double lsl_pull_sample_str(void* inlet, char** texts, std::int32_t room, double, std::int32_t* error) {
    const std::lock_guard lock(stand_in().mutex);
    const auto stream = known_inlet(inlet);
    *error = !stream || room != stream->channels ? kArgumentError : 0;
    if (*error != 0) {
        if (stream) note("a buffer of another size than a sample");
        return 0.0;
    }
    if (stream->is_lost) *error = kLostError;
    if (stream->is_lost || stream->waiting.empty()) return 0.0;
    const auto [stamp_s, sample] = stream->waiting.front();
    stream->waiting.pop_front();
    for (std::size_t i = 0; i < sample.size(); ++i) texts[i] = given_string(sample[i]);
    return stamp_s;
}

}  // extern "C"
