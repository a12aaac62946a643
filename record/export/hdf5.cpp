// SPDX-License-Identifier: MIT
#include <hdf5.h>

#include <array>
#include <utility>

#include "base/try.hpp"
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"

namespace burin::record {
namespace {

constexpr hsize_t kChunkRows = 4096;  // 32 kB of a column
constexpr unsigned kDeflateLevel = 1;

// Closes an identifier of the library's at its end. Below 0: there is none.
class H5Handle {
public:
    using Close = herr_t (*)(hid_t);
    H5Handle() = default;
    H5Handle(hid_t id, Close close) : id_(id), close_(close) {}
    ~H5Handle() { static_cast<void>(close()); }
    H5Handle(H5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    H5Handle& operator=(H5Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }

    [[nodiscard]] hid_t id() const { return id_; }
    [[nodiscard]] bool is_open() const { return id_ >= 0; }
    // Returns whether it was closed without a failure; what was written may fail only now.
    [[nodiscard]] bool close() {
        const hid_t id = std::exchange(id_, -1);
        return id < 0 || close_(id) >= 0;
    }

private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

hid_t h5_type(ColumnType type) {
    switch (type) {
        case ColumnType::f64: return H5T_IEEE_F64LE;
        case ColumnType::i64: return H5T_STD_I64LE;
        case ColumnType::u32: return H5T_STD_U32LE;
    }
    return -1;
}

// A name in a group: a slash would begin another group.
std::string h5_name(std::string name) {
    for (char& c : name)
        if (c == '/' || c == '\0') c = '_';
    return name == "." ? "_" : name;
}

// Texts of any length in UTF-8.
H5Handle h5_text_type() {
    H5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    const bool ok =
        type.is_open() && H5Tset_size(type.id(), H5T_VARIABLE) >= 0 && H5Tset_cset(type.id(), H5T_CSET_UTF8) >= 0;
    return ok ? std::move(type) : H5Handle();
}

bool put_h5_attribute(hid_t object, const char* name, const std::string& text) {
    const H5Handle type = h5_text_type(), space(H5Screate(H5S_SCALAR), H5Sclose);
    const H5Handle attribute(H5Acreate2(object, name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const char* const value = text.c_str();
    return attribute.is_open() && H5Awrite(attribute.id(), type.id(), static_cast<const void*>(&value)) >= 0;
}

// Writes a list as a dataset; an empty list is one of length 0.
bool put_h5_list(hid_t group, const char* name, hid_t type, std::size_t length, const void* values) {
    const hsize_t size = length;
    const H5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const H5Handle list(H5Dcreate2(group, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    return list.is_open() && (length == 0 || H5Dwrite(list.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
}

bool put_h5_texts(hid_t group, const char* name, const std::vector<std::string>& texts) {
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    const H5Handle type = h5_text_type();
    return type.is_open() && put_h5_list(group, name, type.id(), texts.size(), pointers.data());
}

H5Handle make_h5_group(hid_t file, const char* name) {
    return {H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose};
}

// One column that grows.
struct H5Column {
    H5Handle dataset;
    hsize_t rows = 0;

    [[nodiscard]] bool create(hid_t group, const Column& column) {
        const hsize_t none = 0, unlimited = H5S_UNLIMITED;
        const H5Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose);
        const H5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        if (H5Pset_chunk(layout.id(), 1, &kChunkRows) < 0 || H5Pset_deflate(layout.id(), kDeflateLevel) < 0)
            return false;
        dataset = H5Handle(H5Dcreate2(group, h5_name(column.name).c_str(), h5_type(column.type), space.id(),
                                      H5P_DEFAULT, layout.id(), H5P_DEFAULT),
                           H5Dclose);
        return dataset.is_open() && put_h5_attribute(dataset.id(), "unit", column.unit) &&
               put_h5_attribute(dataset.id(), "frame", column.frame);
    }
    [[nodiscard]] bool append(const Block& block, std::size_t column) {
        const hsize_t count = block.rows(), grown = rows + count;
        if (H5Dset_extent(dataset.id(), &grown) < 0) return false;
        const H5Handle all(H5Dget_space(dataset.id()), H5Sclose), part(H5Screate_simple(1, &count, nullptr), H5Sclose);
        if (H5Sselect_hyperslab(all.id(), H5S_SELECT_SET, &rows, nullptr, &count, nullptr) < 0) return false;
        rows = grown;
        return H5Dwrite(dataset.id(), h5_type(block.type(column)), part.id(), all.id(), H5P_DEFAULT,
                        block.bytes(column).data()) >= 0;
    }
};

bool put_h5_facts(hid_t file, const RecordReader& reader, std::size_t table) {
    std::vector<std::string> keys, values, names;
    for (const auto& [key, value] : reader.facts()) {
        keys.push_back(key);
        values.push_back(value);
    }
    std::vector<std::int64_t> numbers;
    for (const RecordedObject& object : reader.table(table).objects) {
        numbers.push_back(object.number);
        names.push_back(object.name);
    }
    const H5Handle meta = make_h5_group(file, "meta"), objects = make_h5_group(file, "objects");
    return meta.is_open() && objects.is_open() && put_h5_texts(meta.id(), "key", keys) &&
           put_h5_texts(meta.id(), "value", values) &&
           put_h5_list(objects.id(), "number", H5T_NATIVE_INT64, numbers.size(), numbers.data()) &&
           put_h5_texts(objects.id(), "name", names);
}

}  // namespace

Result<ExportReport> export_hdf5(RecordReader& reader, std::size_t table, const std::vector<std::size_t>& columns,
                                 const std::string& path, const TickTimes& times) {
    Result<NewFile> file = NewFile::create(path);
    if (!file) return std::unexpected(file.error());
    if (file->is_standard_output()) return fail("hdf5", "cannot go to standard output", "name a file");
    // What could not be written on a full disk stays in the library's hands, and its clearing up at the program's end
    // writes it again and then uses what it has freed.
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // failures are told by what is returned
    const auto failed = [&] { return fail(path, "cannot be written as HDF5", "check whether the disk is full"); };
    H5Handle h5(H5Fcreate(file->temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    if (!h5.is_open()) return failed();
    H5Handle ticks = make_h5_group(h5.id(), "ticks");
    std::vector<H5Column> written(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const Column& column = reader.table(table).columns[columns[i]];
        if (!written[i].create(ticks.id(), column))
            return fail(path,
                        "column " + column.name + " cannot be made: the recording names it twice, or the disk is full",
                        "leave it out by --columns, or free some space");
    }
    if (!put_h5_facts(h5.id(), reader, table)) return failed();
    ExportReport report{0, columns.size(), {}};
    const auto done = each_block(reader, table, times, report, [&](const Block& block) -> Result<void> {
        for (std::size_t i = 0; i < columns.size(); ++i)
            if (!written[i].append(block, columns[i])) return failed();
        return {};
    });
    if (!done) return std::unexpected(done.error());
    bool closed = true;
    for (H5Column& column : written) closed = column.dataset.close() && closed;
    closed = ticks.close() && closed;
    closed = h5.close() && closed;
    if (!closed) return failed();
    BURIN_TRY_DO(file->finish());
    return report;
}

}  // namespace burin::record
