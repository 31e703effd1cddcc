#include "studies/hdf5_results.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <map>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "messages/input_error.h"
#include "twin/durable_file.h"

namespace whirl_twin {

namespace {

constexpr hsize_t kChunk = 16384;  // rows
constexpr unsigned kCompression = 4;
constexpr std::size_t kGrowth = 4096;  // bytes, growth of the file in memory

/// An HDF5 identifier; closed by the destructor.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id_ < 0) {  // all is in memory
      throw std::bad_alloc();
    }
  }
  ~Handle() {
    if (id_ >= 0) {
      close_(id_);
    }
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t status) {
  if (status < 0) {
    throw std::bad_alloc();
  }
}

Handle properties(hid_t kind) {
  return {H5Pcreate(kind), H5Pclose};
}

Handle scalar() {
  return {H5Screate(H5S_SCALAR), H5Sclose};
}

Handle vectorSpace(hsize_t size) {
  return {H5Screate_simple(1, &size, nullptr), H5Sclose};
}

/// UTF-8 of a fixed number of bytes, zero padded.
Handle textType(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, std::max<std::size_t>(size, 1)));
  check(H5Tset_strpad(type, H5T_STR_NULLPAD));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

void writeAttribute(hid_t of, const char* name, hid_t type, const Handle& space, const void* data) {
  const Handle attribute(H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute, type, data));
}

void attach(hid_t of, const char* name, const std::string& text) {
  std::string bytes = text;  // also an empty text has a byte
  bytes.resize(std::max<std::size_t>(bytes.size(), 1));
  writeAttribute(of, name, textType(text.size()), scalar(), bytes.data());
}

void attach(hid_t of, const char* name, double value) {
  writeAttribute(of, name, H5T_NATIVE_DOUBLE, scalar(), &value);
}

void attach(hid_t of, const char* name, std::uint64_t value) {
  writeAttribute(of, name, H5T_NATIVE_UINT64, scalar(), &value);
}

template <class Numbers>
void attachNumbers(hid_t of, const char* name, const Numbers& values) {
  writeAttribute(of, name, H5T_NATIVE_DOUBLE, vectorSpace(values.size()), values.data());
}

void attach(hid_t of, const char* name, const Estimate& estimate) {
  attachNumbers(of, name, std::vector<double>{estimate.value, estimate.low, estimate.high});
}

/// Without creation time.
Handle makeGroup(hid_t in, const std::string& name) {
  const Handle how = properties(H5P_GROUP_CREATE);
  check(H5Pset_obj_track_times(how, false));
  return {H5Gcreate2(in, name.c_str(), H5P_DEFAULT, how, H5P_DEFAULT), H5Gclose};
}

/// A column of a table, written in chunks.
class Column {
 public:
  Column(hid_t in, const std::string& name, hid_t type)
      : type_(H5Tcopy(type), H5Tclose), size_(H5Tget_size(type)), data_(make(in, name)) {}

  hid_t data() const { return data_; }
  /// The next row: as many bytes as the type has.
  void add(const void* row) {
    const auto* const bytes = static_cast<const char*>(row);
    rows_.insert(rows_.end(), bytes, bytes + size_);
    if (rows_.size() == kChunk * size_) {
      flush();
    }
  }
  void add(double value) { add(static_cast<const void*>(&value)); }
  void add(std::uint64_t value) { add(static_cast<const void*>(&value)); }
  void add(std::string text) {
    text.resize(size_);
    add(static_cast<const void*>(text.data()));
  }
  void flush() {
    const hsize_t count = rows_.size() / size_;
    if (count == 0) {
      return;
    }
    const hsize_t end = written_ + count;
    check(H5Dset_extent(data_, &end));
    const Handle place(H5Dget_space(data_), H5Sclose);
    check(H5Sselect_hyperslab(place, H5S_SELECT_SET, &written_, nullptr, &count, nullptr));
    check(H5Dwrite(data_, type_, vectorSpace(count), place, H5P_DEFAULT, rows_.data()));
    written_ = end;
    rows_.clear();
  }

 private:
  Handle make(hid_t in, const std::string& name) const {
    const Handle how = properties(H5P_DATASET_CREATE);
    check(H5Pset_obj_track_times(how, false));
    check(H5Pset_chunk(how, 1, &kChunk));
    check(H5Pset_shuffle(how));
    check(H5Pset_deflate(how, kCompression));
    const hsize_t none = 0;
    const hsize_t any = H5S_UNLIMITED;
    const Handle space(H5Screate_simple(1, &none, &any), H5Sclose);
    return {H5Dcreate2(in, name.c_str(), type_, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose};
  }

  Handle type_;
  std::size_t size_;
  Handle data_;
  std::vector<char> rows_;
  hsize_t written_ = 0;
};

/// A column for each varied number.
std::vector<Column> numbersThatVary(hid_t in, const Study& study) {
  const Handle group = makeGroup(in, "vary");
  std::vector<Column> columns;
  for (const Variation& variation : study.vary) {
    columns.emplace_back(group, variation.path, H5T_NATIVE_DOUBLE);
    attach(columns.back().data(), "unit", variation.unit);
    attach(columns.back().data(), "nominal", variation.nominal);
  }
  return columns;
}

std::vector<Column> measures(hid_t in, const Study& study, const Answers& answers) {
  const Handle group = makeGroup(in, "measure");
  std::vector<Column> columns;
  for (std::size_t k = 0; k < study.measures.size(); ++k) {
    columns.emplace_back(group, study.measures[k].name, H5T_NATIVE_DOUBLE);
    const hid_t data = columns.back().data();
    const Distributed& d = answers.measures[k];
    attach(data, "expression", study.measures[k].text);
    attach(data, "unit", study.measures[k].unit);
    attach(data, "count", d.count);
    attach(data, "undefined", d.undefined);
    attach(data, "mean", d.mean);
    attach(data, "standard_deviation", d.deviation);
    attach(data, "smallest", d.smallest);
    attach(data, "largest", d.largest);
    attachNumbers(data, "percentiles", d.percentiles);
    attachNumbers(data, "percentiles_at", kPercentiles);
  }
  return columns;
}

/// Size of the longest reason.
std::size_t reasonSize(const ResultFolder& folder) {
  std::size_t size = 1;
  folder.forEachPoint(
      [&](const PointResult& result) { size = std::max(size, result.outcome.failure.size()); });
  return size;
}

void writePoints(hid_t file, const Study& study, const ResultFolder& folder,
                 const Answers& answers) {
  const Handle failed = makeGroup(file, "failed");
  Column point(file, "point", H5T_NATIVE_UINT64);
  std::vector<Column> vary = numbersThatVary(file, study);
  std::vector<Column> measured = measures(file, study, answers);
  Column failed_point(failed, "point", H5T_NATIVE_UINT64);
  Column reason(failed, "reason", textType(answers.failures > 0 ? reasonSize(folder) : 1));
  std::vector<Column> failed_vary = numbersThatVary(failed, study);
  folder.forEachPoint([&](const PointResult& result) {
    const Outcome& outcome = result.outcome;
    const bool good = outcome.failure.empty();
    (good ? point : failed_point).add(result.point);
    std::vector<Column>& numbers = good ? vary : failed_vary;
    for (std::size_t j = 0; j < numbers.size(); ++j) {
      numbers[j].add(result.values[j]);
    }
    for (std::size_t k = 0; k < outcome.measures.size(); ++k) {
      measured[k].add(outcome.measures[k]);
    }
    if (!good) {
      reason.add(outcome.failure);
    }
  });
  for (Column* column : {&point, &failed_point, &reason}) {
    column->flush();
  }
  for (std::vector<Column>* columns : {&vary, &measured, &failed_vary}) {
    for (Column& column : *columns) {
      column.flush();
    }
  }
}

void writeYield(hid_t file, const Study& study, const Answers& answers) {
  std::vector<std::pair<std::string, Yield>> yields;
  for (std::size_t k = 0; k < study.requirements.size(); ++k) {
    yields.emplace_back(text(study.requirements[k], study), answers.requirements[k]);
  }
  if (answers.yield) {
    yields.emplace_back("all", *answers.yield);
  }
  std::size_t longest = 1;
  for (const auto& [requirement, yield] : yields) {
    longest = std::max(longest, requirement.size());
  }
  const Handle group = makeGroup(file, "require");
  Column requirement(group, "requirement", textType(longest));
  Column passed(group, "passed", H5T_NATIVE_UINT64);
  Column of(group, "of", H5T_NATIVE_UINT64);
  Column part(group, "part", H5T_NATIVE_DOUBLE);
  Column low(group, "low", H5T_NATIVE_DOUBLE);
  Column high(group, "high", H5T_NATIVE_DOUBLE);
  for (const auto& [name, yield] : yields) {
    requirement.add(name);
    passed.add(yield.passed);
    of.add(yield.of);
    part.add(yield.part());
    low.add(yield.low);
    high.add(yield.high);
  }
  for (Column* column : {&requirement, &passed, &of, &part, &low, &high}) {
    column->flush();
  }
}

void writeSensitivities(hid_t file, const Study& study, const Answers& answers) {
  if (!answers.sobol.empty()) {
    const Handle group = makeGroup(file, "sobol");
    for (std::size_t k = 0; k < study.measures.size(); ++k) {
      const SobolIndices& indices = answers.sobol[k];
      const Handle measure = makeGroup(group, study.measures[k].name);
      attach(measure, "rows", indices.rows);
      attach(measure, "left_out", indices.left_out);
      for (std::size_t j = 0; j < study.vary.size(); ++j) {
        const Handle number = makeGroup(measure, study.vary[j].path);
        attach(number, "first", indices.first[j]);
        attach(number, "total", indices.total[j]);
      }
    }
  }
  if (!answers.morris.empty()) {
    const Handle group = makeGroup(file, "morris");
    for (std::size_t k = 0; k < study.measures.size(); ++k) {
      const MorrisEffects& effects = answers.morris[k];
      const Handle measure = makeGroup(group, study.measures[k].name);
      attach(measure, "trajectories", effects.trajectories);
      attach(measure, "left_out", effects.left_out);
      for (std::size_t j = 0; j < study.vary.size(); ++j) {
        const Handle number = makeGroup(measure, study.vary[j].path);
        attach(number, "mean", effects.mean[j]);
        attach(number, "mean_magnitude", effects.mean_magnitude[j]);
        attach(number, "standard_deviation", effects.deviation[j]);
      }
    }
  }
}

/// A file in memory, so that it is written completely or not at all.
Handle fileInMemory() {
  const Handle access = properties(H5P_FILE_ACCESS);
  check(H5Pset_fapl_core(access, kGrowth, false));
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18));
  const Handle creation = properties(H5P_FILE_CREATE);
  check(H5Pset_obj_track_times(creation, false));
  check(H5Pset_attr_phase_change(creation, 0, 0));  // texts may be longer than 64 kB
  return {H5Fcreate("results.h5", H5F_ACC_TRUNC, creation, access), H5Fclose};
}

/// Its content. (H5Fget_file_image() gives a wrong superblock checksum for this format.)
std::string imageOf(hid_t file) {
  check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  hsize_t size = 0;
  check(H5Fget_filesize(file, &size));
  void* bytes = nullptr;
  check(H5Fget_vfd_handle(file, H5P_DEFAULT, &bytes));
  return {*static_cast<const char**>(bytes), size};
}

}  // namespace

void writeHdf5Results(const Study& study, const ResultFolder& folder, const Answers& answers) {
  const std::string path = folder.path() + "/results.h5";
  check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
  DurableFile to(path);
  try {
    const Handle file = fileInMemory();
    attach(file, "study", study.text);
    attach(file, "scene", study.scene_text);
    attach(file, "design", name(study.design.kind));
    attach(file, "points", answers.points);
    attach(file, "failures", answers.failures);
    writePoints(file, study, folder, answers);
    writeYield(file, study, answers);
    writeSensitivities(file, study, answers);
    to.add(imageOf(file));
  } catch (const std::bad_alloc&) {
    throwNotWritten(path, ENOMEM);
  }
  to.finish();
}

}  // namespace whirl_twin
