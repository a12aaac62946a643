// SPDX-License-Identifier: MIT
// Written from "MAT-File Format" (The MathWorks, R2021a), chapter "Level 5 MAT-Files". A data element is a tag (type
// and length of its data, 32 bits each) and the data, filled up to a multiple of 8 bytes.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <limits>
#include <set>

#include "base/try.hpp"
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"

namespace burin::record {
namespace {

// Types of data elements, and classes of arrays.
enum MatType : std::uint32_t {
    kMatInt8 = 1,
    kMatUtf16 = 17,
    kMatInt32 = 5,
    kMatUint32 = 6,
    kMatDouble = 9,
    kMatInt64 = 12,
    kMatMatrix = 14
};
enum MatClass : std::uint32_t { kMatChars = 4, kMatDoubles = 6, kMatUint32s = 13, kMatInt64s = 14 };

constexpr std::uint64_t kMostMatBytes = (std::uint64_t{1} << 31) - 1;  // of a variable
constexpr std::size_t kMostMatName = 63;

template <typename T>
void append_number(std::string& bytes, T value) {
    std::array<char, sizeof value> raw{};
    std::memcpy(raw.data(), &value, sizeof value);
    bytes.append(raw.data(), raw.size());
}

constexpr std::uint64_t filled_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

void append_tag(std::string& bytes, std::uint32_t type, std::uint64_t length) {
    append_number(bytes, type);
    append_number(bytes, static_cast<std::uint32_t>(length));
}

// What describes an array of one row or one column.
struct MatArray {
    std::string name;
    std::uint32_t array_class = kMatDoubles, data_type = kMatDouble;
    std::uint64_t rows = 0, columns = 1;
    std::size_t value_bytes = 8;

    [[nodiscard]] std::uint64_t data_bytes() const { return rows * columns * value_bytes; }
    // Returns the bytes before the data: the tags, flags, dimensions and the name.
    [[nodiscard]] std::string head() const {
        std::string body;
        append_tag(body, kMatUint32, 8);
        append_number(body, array_class);
        append_number(body, std::uint32_t{0});
        append_tag(body, kMatInt32, 8);
        append_number(body, static_cast<std::int32_t>(rows));
        append_number(body, static_cast<std::int32_t>(columns));
        append_tag(body, kMatInt8, name.size());
        body += name;
        body.resize(filled_up(body.size()), '\0');
        append_tag(body, data_type, data_bytes());
        std::string all;
        append_tag(all, kMatMatrix, body.size() + filled_up(data_bytes()));
        return all + body;
    }
};

MatArray array_of(const std::string& name, ColumnType type, std::uint64_t rows) {
    switch (type) {
        case ColumnType::f64: return {name, kMatDoubles, kMatDouble, rows, 1, 8};
        case ColumnType::i64: return {name, kMatInt64s, kMatInt64, rows, 1, 8};
        case ColumnType::u32: return {name, kMatUint32s, kMatUint32, rows, 1, 4};
    }
    return {};
}

// A name as MATLAB has them: a letter, then letters, digits and underscores.
std::string mat_name(std::string name) {
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 || static_cast<unsigned char>(c) > 127) c = '_';
    if (name.empty() || std::isalpha(static_cast<unsigned char>(name.front())) == 0) name.insert(0, "c");
    return name.substr(0, kMostMatName);
}

// Appends the next character of a text in UTF-8 as one unit of UTF-16, and returns the place behind it. What is no
// character, or would need two units, becomes U+FFFD: readers disagree whether the length of a text counts units.
std::size_t append_utf16(std::string& to, std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned first = byte(at);
    const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
    std::uint32_t code = length == 1 ? first : first & (0x7fu >> length);
    bool is_sound = length > 0;
    for (std::size_t i = 1; i < length && is_sound; ++i) {
        is_sound = (byte(at + i) & 0xc0u) == 0x80u;
        code = code << 6 | (byte(at + i) & 0x3fu);
    }
    const bool is_one_unit = is_sound && code < 0x10000 && !(code >= 0xd800 && code < 0xe000);
    append_number(to, is_one_unit ? static_cast<std::uint16_t>(code) : std::uint16_t{0xfffd});
    return at + (is_sound ? length : 1);
}

// A text as a whole variable.
std::string text_variable(const std::string& name, std::string_view text) {
    std::string units;
    for (std::size_t at = 0; at < text.size();) at = append_utf16(units, text, at);
    std::string all = MatArray{name, kMatChars, kMatUtf16, 1, units.size() / 2, 2}.head() + units;
    all.resize(filled_up(all.size()), '\0');
    return all;
}

std::string mat_header() {
    std::string header = "MATLAB 5.0 MAT-file, ticks of a Burin session";
    header.resize(124, ' ');
    header.replace(116, 8, 8, '\0');  // no data of subsystems
    append_number(header, std::uint16_t{0x0100});
    return header + "IM";
}

std::string mat_texts(const RecordReader& reader, std::size_t table, const std::vector<std::size_t>& columns) {
    std::string described, facts, objects;
    for (const std::size_t c : columns) {
        const Column& column = reader.table(table).columns[c];
        described +=
            column.name + "\t" + column.unit + "\t" + column.frame + "\t" + std::string(name_of(column.type)) + "\n";
    }
    for (const auto& [key, value] : reader.facts()) facts += key + "\t" + in_a_line(value) + "\n";
    for (const RecordedObject& object : reader.table(table).objects)
        objects += std::to_string(object.number) + "\t" + object.name + "\n";
    return text_variable("burin_columns", described) + text_variable("burin_meta", facts) +
           text_variable("burin_objects", objects);
}

struct MatVariable {
    std::size_t column = 0;
    std::uint64_t data_at = 0, written = 0;  // bytes
};

// Counts the rows that can be read, since each vector's length stands before it.
Result<std::uint64_t> readable_rows(RecordReader& reader, std::size_t table, const TickTimes& times) {
    ExportReport first{};
    const auto read = each_block(reader, table, times, first, [](const Block&) { return Result<void>(); });
    if (!read) return std::unexpected(read.error());
    return first.rows;
}

}  // namespace

Result<ExportReport> export_mat(RecordReader& reader, std::size_t table, const std::vector<std::size_t>& columns,
                                const std::string& path, const TickTimes& times) {
    Result<NewFile> file = NewFile::create(path);
    if (!file) return std::unexpected(file.error());
    if (file->is_standard_output()) return fail("mat", "cannot go to standard output", "name a file");
    BURIN_TRY(rows, readable_rows(reader, table, times));
    if (rows > kMostMatBytes / 8)
        return fail(path, std::to_string(rows) + " ticks make variables above 2 GiB, which MATLAB does not read",
                    "use --to hdf5");
    std::string text = mat_header() + mat_texts(reader, table, columns);
    std::uint64_t at = text.size();
    BURIN_TRY_DO(file->write(text));
    std::vector<MatVariable> variables;
    std::set<std::string> names;
    for (const std::size_t c : columns) {
        const Column& column = reader.table(table).columns[c];
        const MatArray array = array_of(mat_name(column.name), column.type, rows);
        if (!names.insert(array.name).second)
            return fail(path, "two columns would be called " + array.name, "leave one out by --columns");
        const std::string head = array.head();
        BURIN_TRY_DO(file->write_at(at, head));
        variables.push_back({c, at + head.size(), 0});
        const std::uint64_t data = array.data_bytes(), end = at + head.size() + filled_up(data);
        const std::string rest(end - (at + head.size() + data), '\0');
        BURIN_TRY_DO(file->write_at(end - rest.size(), rest));
        at = end;
    }
    ExportReport report{0, columns.size(), {}};
    const auto done = each_block(reader, table, times, report, [&](const Block& block) -> Result<void> {
        if (report.rows + block.rows() > rows)
            return fail(path, "the recording has grown meanwhile", "convert it again");
        for (MatVariable& variable : variables) {
            const auto bytes = block.bytes(variable.column);
            const std::string_view raw(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            const auto written = file->write_at(variable.data_at + variable.written, raw);
            if (!written) return written;
            variable.written += raw.size();
        }
        return {};
    });
    if (!done) return std::unexpected(done.error());
    if (report.rows != rows) return fail(path, "the recording has changed meanwhile", "convert it again");
    BURIN_TRY_DO(file->finish());
    return report;
}

}  // namespace burin::record
