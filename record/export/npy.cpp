// SPDX-License-Identifier: MIT
#include <cstring>

#include "base/try.hpp"
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"

namespace burin::record {
namespace {

const char* numpy_type(ColumnType type) {
    switch (type) {
        case ColumnType::f64: return "<f8";
        case ColumnType::i64: return "<i8";
        case ColumnType::u32: return "<u4";
    }
    return "";
}

// A name as a Python literal.
std::string quoted(const std::string& name) {
    std::string text = "'";
    for (const char c : name) {
        if (c == '\'' || c == '\\') text += '\\';
        text += static_cast<unsigned char>(c) < ' ' ? '_' : c;
    }
    return text + "'";
}

// The number of rows takes always as much room, so that it can be set when it is known.
std::string numpy_header(const HandRecord& hand, const std::vector<std::size_t>& columns, std::uint64_t rows) {
    std::string dictionary = "{'descr': [";
    for (const std::size_t column : columns)
        dictionary += "(" + quoted(hand.columns[column].name) + ", '" + numpy_type(hand.columns[column].type) + "'), ";
    std::string count = std::to_string(rows) + ",)";
    count.resize(22, ' ');
    dictionary += "], 'fortran_order': False, 'shape': (" + count + ", }";
    // Version 1.0 states the length in two bytes, 2.0 in four; the data begin at a multiple of 64, as NumPy's do.
    const bool is_long = dictionary.size() + 64 > 0xffff;
    const std::size_t before = is_long ? 12 : 10;
    const std::size_t size = (before + dictionary.size() + 1 + 63) / 64 * 64 - before;
    dictionary.resize(size - 1, ' ');
    dictionary += '\n';
    std::string header("\x93NUMPY", 6);
    header += is_long ? '\2' : '\1';
    header += '\0';
    for (std::size_t i = 0; i < (is_long ? 4u : 2u); ++i) header += static_cast<char>(size >> (8 * i) & 0xff);
    return header + dictionary;
}

}  // namespace

Result<ExportReport> export_npy(RecordReader& reader, std::size_t table, const std::vector<std::size_t>& columns,
                                const std::string& path, const TickTimes& times) {
    const HandRecord& of = reader.table(table);
    Result<NewFile> file = NewFile::create(path);
    if (!file) return std::unexpected(file.error());
    if (file->is_standard_output()) return fail("npy", "cannot go to standard output", "name a file");
    BURIN_TRY_DO(file->write(numpy_header(of, columns, 0)));
    ExportReport report{0, columns.size(), {}};
    std::string record;
    const auto done = each_block(reader, table, times, report, [&](const Block& block) -> Result<void> {
        for (std::uint32_t row = 0; row < block.rows(); ++row) {
            record.clear();
            for (const std::size_t column : columns) {
                const Word word = block.at(column, row);
                record.append(reinterpret_cast<const char*>(&word), size_of(block.type(column)));
            }
            BURIN_TRY_DO(file->write(record));
        }
        return {};
    });
    if (!done) return std::unexpected(done.error());
    BURIN_TRY_DO(file->write_at(0, numpy_header(of, columns, report.rows)));
    BURIN_TRY_DO(file->finish());
    return report;
}

}  // namespace burin::record
