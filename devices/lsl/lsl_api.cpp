// SPDX-License-Identifier: MIT
#include "devices/lsl/lsl_api.hpp"

#include <cstdlib>

#include "base/text.hpp"
#include "devices/drivers/loaded_library.hpp"

namespace burin::devices {
namespace {

constexpr const char* kLslWhere = "Lab Streaming Layer";
constexpr std::int32_t kLslProtocol = 1;  // the major version; those of other ones do not understand each other

std::string lsl_remedy() {
    return std::string("install liblsl from github.com/sccn/liblsl/releases, or name its file: ") + kLslPathVariable +
           "=/path/to/liblsl.so";
}

Result<LslApi> lsl_functions(LoadedLibrary& loaded, const std::string& library) {
    LslApi api;
    api.library = library;
    loaded.find("lsl_protocol_version", api.protocol_version);
    loaded.find("lsl_library_version", api.library_version);
    loaded.find_if_there("lsl_last_error", api.last_error);
    loaded.find("lsl_local_clock", api.local_clock);
    loaded.find("lsl_destroy_string", api.destroy_string);
    loaded.find("lsl_create_streaminfo", api.create_info);
    loaded.find("lsl_destroy_streaminfo", api.destroy_info);
    loaded.find("lsl_get_name", api.name_of);
    loaded.find("lsl_get_source_id", api.source_id_of);
    loaded.find("lsl_get_uid", api.uid_of);
    loaded.find("lsl_get_channel_count", api.channels_of);
    loaded.find("lsl_get_desc", api.description_of);
    loaded.find("lsl_append_child", api.append_child);
    loaded.find("lsl_append_child_value", api.append_child_value);
    loaded.find("lsl_create_outlet", api.create_outlet);
    loaded.find("lsl_destroy_outlet", api.destroy_outlet);
    loaded.find("lsl_push_chunk_ftnp", api.push_floats);
    loaded.find("lsl_push_sample_strtp", api.push_text);
    loaded.find("lsl_create_continuous_resolver_bypred", api.create_resolver);
    loaded.find("lsl_resolver_results", api.resolved);
    loaded.find("lsl_destroy_continuous_resolver", api.destroy_resolver);
    loaded.find("lsl_create_inlet", api.create_inlet);
    loaded.find("lsl_destroy_inlet", api.destroy_inlet);
    loaded.find("lsl_open_stream", api.open_stream);
    loaded.find("lsl_time_correction", api.time_correction);
    loaded.find("lsl_pull_sample_str", api.pull_text);
    if (!loaded.missing().empty())
        return fail(kLslWhere, "the library " + library + " has no function " + loaded.missing(),
                    "it is not liblsl, or too old: " + lsl_remedy());
    const std::int32_t protocol = api.protocol_version();
    if (protocol / 100 != kLslProtocol)
        return fail(kLslWhere,
                    "the library " + library + " speaks protocol " +
                        formatted("%d.%02d", protocol / 100, protocol % 100) + ", and Burin knows 1.x",
                    lsl_remedy());
    return api;
}

std::unexpected<Error> no_lsl_library(const std::string& library, const std::string& why) {
    return fail(kLslWhere, "the library " + library + " cannot be loaded: " + why, lsl_remedy());
}

}  // namespace

std::string LslApi::why() const {
    const char* const text = last_error != nullptr ? last_error() : nullptr;
    return text != nullptr && *text != 0 ? text : "the library gives no reason";
}

std::string LslApi::version() const {
    const std::int32_t version = library_version();
    return formatted("%d.%d", version / 100, version % 100);
}

Result<LslApi> load_lsl_api(const std::string& library) {
    LoadedLibrary loaded(library);
    if (!loaded.is_there()) return no_lsl_library(library, loaded.why());
    return lsl_functions(loaded, library);
}

Result<LslApi> load_lsl_api() {
    if (const char* const named = std::getenv(kLslPathVariable); named != nullptr && *named != 0)
        return load_lsl_api(named);
    std::string why;
    for (const char* const name : {"liblsl.so.2", "liblsl.so"}) {
        LoadedLibrary loaded(name);
        if (loaded.is_there()) return lsl_functions(loaded, name);
        if (why.empty()) why = loaded.why();
    }
    return no_lsl_library("liblsl.so.2", why);
}

DevicePresence look_for_lsl() {
    const Result<LslApi> api = load_lsl_api();
    if (api)
        return {Presence::there,
                "",
                "liblsl " + api->version() + " (" + api->library + ") streams a session's ticks and events",
                {}};
    const bool is_absent = api.error().what.contains("cannot be loaded");
    return {is_absent ? Presence::absent : Presence::unusable, "", api.error().what, api.error().remedy};
}

}  // namespace burin::devices
