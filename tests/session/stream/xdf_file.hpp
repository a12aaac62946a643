// SPDX-License-Identifier: MIT
// Streams of the library that stands in for liblsl, as a file of XDF 1.0 (github.com/sccn/xdf/wiki/Specifications): a
// file header, and of each stream a header, its samples with a stamp each, and a footer. For readers of others.
#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/session/stream/lsl_stand_in.hpp"

namespace burin::test {

// Appends values as they lie in memory: XDF is little-endian.
template <typename T>
void append_bytes(std::string& to, const T& value) {
    static_assert(std::endian::native == std::endian::little);
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A number with how many bytes it takes before it.
inline void append_length(std::string& to, std::uint64_t length) {
    to += static_cast<char>(8);
    append_bytes(to, length);
}

inline void append_chunk(std::string& to, std::uint16_t tag, const std::string& content) {
    append_length(to, content.size() + sizeof tag);
    append_bytes(to, tag);
    to += content;
}

inline std::string escaped_xml(std::string_view text) {
    std::string all;
    for (const char c : text) all += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : std::string(1, c);
    return all;
}

inline std::string xml_of(const LslNode& node) {
    std::string inner = escaped_xml(node.text);
    for (const auto& child : node.children) inner += xml_of(*child);
    return "<" + node.name + ">" + inner + "</" + node.name + ">";
}

inline std::string header_of(const LslStream& stream) {
    std::string description;
    for (const auto& child : stream.description->children) description += xml_of(*child);
    return "<?xml version=\"1.0\"?><info><name>" + escaped_xml(stream.name) + "</name><type>" +
           escaped_xml(stream.type) + "</type><channel_count>" + std::to_string(stream.channels) +
           "</channel_count><nominal_srate>" + std::to_string(stream.rate_Hz) + "</nominal_srate><channel_format>" +
           (stream.format == 3 ? "string" : "float32") + "</channel_format><source_id>" +
           escaped_xml(stream.source_id) + "</source_id><desc>" + description + "</desc></info>";
}

inline std::string samples_of(const LslStream& stream) {
    std::string samples;
    append_length(samples, stream.stamps_s.size());
    const auto channels = static_cast<std::size_t>(stream.channels);
    for (std::size_t i = 0; i < stream.stamps_s.size(); ++i) {
        samples += static_cast<char>(8);
        append_bytes(samples, stream.stamps_s[i]);
        for (std::size_t c = i * channels; c < (i + 1) * channels; ++c) {
            if (stream.format != 3) {
                append_bytes(samples, stream.values[c]);
                continue;
            }
            append_length(samples, stream.texts[c].size());
            samples += stream.texts[c];
        }
    }
    return samples;
}

inline void write_xdf(const char* path, const std::vector<std::shared_ptr<LslStream>>& streams) {
    constexpr std::uint16_t kFileHeader = 1, kStreamHeader = 2, kSamples = 3, kStreamFooter = 6;
    std::string file = "XDF:";
    append_chunk(file, kFileHeader, "<?xml version=\"1.0\"?><info><version>1.0</version></info>");
    for (std::uint32_t id = 1; id <= streams.size(); ++id) {
        const LslStream& stream = *streams[id - 1];
        const auto chunk = [&](std::uint16_t tag, const std::string& content) {
            std::string with_id;
            append_bytes(with_id, id);
            append_chunk(file, tag, with_id + content);
        };
        chunk(kStreamHeader, header_of(stream));
        if (!stream.stamps_s.empty()) chunk(kSamples, samples_of(stream));
        const std::string count = std::to_string(stream.stamps_s.size());
        chunk(kStreamFooter, "<?xml version=\"1.0\"?><info><sample_count>" + count + "</sample_count></info>");
    }
    std::FILE* const to = std::fopen(path, "wb");
    if (to == nullptr) return;
    std::fwrite(file.data(), 1, file.size(), to);
    std::fclose(to);
}

}  // namespace burin::test
