// SPDX-License-Identifier: MIT
#include "geometry/vrml/vrml_text.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>

namespace burin::geometry {

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

Result<std::string> gunzipped(std::string_view bytes, std::size_t most, const std::string& name) {
    z_stream stream{};
    constexpr int kLargestWindow = 15, kGzipAlone = 16;
    if (inflateInit2(&stream, kLargestWindow + kGzipAlone) != Z_OK)
        return fail(name, "cannot be unpacked: there is not enough memory", "end other programs");
    const std::unique_ptr<z_stream, void (*)(z_stream*)> ends(&stream, [](z_stream* s) { inflateEnd(s); });
    std::string text;
    std::array<char, 1 << 16> part{};
    int code = Z_OK;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    while (code == Z_OK) {
        stream.next_out = reinterpret_cast<Bytef*>(part.data());
        stream.avail_out = static_cast<uInt>(part.size());
        code = inflate(&stream, Z_NO_FLUSH);
        const std::size_t made = part.size() - stream.avail_out;
        if (made > most - text.size())
            return fail(name, "holds more than " + std::to_string(most) + " bytes, packed with gzip",
                        "reduce or split it");
        text.append(part.data(), made);
        // Files of several members are their contents, one behind the other; what follows otherwise is no part of it.
        const std::string_view rest = bytes.substr(bytes.size() - stream.avail_in);
        if (code == Z_STREAM_END && is_gzip(rest)) code = inflateReset(&stream);
    }
    if (code == Z_STREAM_END) return text;
    return fail(name,
                code == Z_BUF_ERROR ? "is packed with gzip, and cut short"
                                    : "is packed with gzip, and what is in it is damaged",
                "copy or export it again");
}

bool is_utf8(std::string_view bytes) {
    const auto at = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
    for (std::size_t i = 0; i < bytes.size();) {
        const unsigned first = at(i);
        const std::size_t more = first < 0x80   ? 0
                                 : first < 0xc2 ? 4
                                 : first < 0xe0 ? 1
                                 : first < 0xf0 ? 2
                                 : first < 0xf5 ? 3
                                                : 4;
        if (more == 4) return false;
        // The second byte's range leaves out longer forms than need be, surrogates, and what lies beyond Unicode.
        const unsigned lowest = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
        const unsigned highest = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
        for (std::size_t k = 1; k <= more; ++k) {
            const unsigned next = at(i + k);
            if (next < (k == 1 ? lowest : 0x80) || next > (k == 1 ? highest : 0xbf)) return false;
        }
        i += 1 + more;
    }
    return true;
}

std::string utf8_of_latin1(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size() + bytes.size() / 8);
    for (const char c : bytes) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x80) {
            text += c;
        } else {
            text += static_cast<char>(0xc0 | code >> 6);
            text += static_cast<char>(0x80 | (code & 0x3f));
        }
    }
    return text;
}

}  // namespace burin::geometry
