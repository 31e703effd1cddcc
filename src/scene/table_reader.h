// Reads a table of numbers row by row, whatever its dialect (table_dialect.h): the memory does not
// depend on its length.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/table_dialect.h"

namespace whirl_twin {

/// Lines of a file through a buffer.
class LineReader {
 public:
  /// Throws InputError, with what is wrong: no file, none that can be read.
  explicit LineReader(const std::string& path);

  /// The next line without its end, valid until the next call. Throws InputError for one longer
  /// than 1 MiB.
  bool next(std::string_view& line);
  std::size_t number() const { return number_; }  ///< of the line, from 1 on
  bool cut() const { return cut_; }               ///< the line has no end
  std::uint64_t offset() const { return offset_; }
  std::uint64_t size() const { return size_; }

 private:
  bool fill();

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what is in the buffer
  std::uint64_t offset_ = 0, size_ = 0;
  std::size_t number_ = 0;
  bool cut_ = false;
};

/// Rows of numbers over time, of a table or of another file of columns.
class NumberTable {
 public:
  virtual ~NumberTable() = default;

  virtual const std::vector<TableColumn>& columns() const = 0;
  /// By heading or name. Throws InputError where there is none, or more than one.
  std::size_t column(const std::string& name) const;
  /// The same; none where there is none.
  std::optional<std::size_t> findColumn(const std::string& name) const;

  /// From now on next() gives numbers of these columns, NaN for gaps, and the instant of a row.
  /// Throws InputError where the file has no time.
  virtual void selectOverTime(const std::vector<std::size_t>& columns) = 0;
  /// The next row; false at the end. Throws InputError for what is no row.
  virtual bool next(std::vector<double>& values) = 0;
  std::int64_t instant() const { return instant_; }  ///< [ns], of this row
  bool hasInstant() const { return has_instant_; }   ///< false: a gap

  virtual std::string place() const = 0;  ///< "line 7"
  virtual std::uint64_t offset() const = 0;
  virtual std::uint64_t size() const = 0;
  virtual std::vector<std::string> remarks() const = 0;
  /// "; read with separator ';', decimal ','": for messages.
  virtual std::string how() const { return ""; }

 protected:
  std::int64_t instant_ = 0;
  bool has_instant_ = false;
};

class TableReader : public NumberTable {
 public:
  /// Reads the first lines. Errors, InputError: as LineReader, UTF-16, names that are duplicates.
  TableReader(const std::string& path, TableSettings settings);

  const std::vector<TableColumn>& columns() const override { return dialect_.columns; }
  /// Of next() alone, without a time.
  void select(std::vector<std::size_t> columns) { selected_ = std::move(columns); }
  /// The time is in the column of the settings, or found by its name; with a rate in the settings
  /// it is a count of samples, or there is none.
  void selectOverTime(const std::vector<std::size_t>& columns) override;

  /// A last line without an end is left out: its last number may be cut. Throws InputError for a
  /// cell that is no number, and for a row with more values than there are names.
  bool next(std::vector<double>& values) override { return nextRow(values, true); }
  /// The same; with the last line in any case where not `complete`.
  bool nextRow(std::vector<double>& values, bool complete);

  std::string place() const override;
  std::uint64_t offset() const override { return lines_.offset(); }
  std::uint64_t size() const override { return lines_.size(); }
  /// Of the dialect, where it is not the plain one, and of a cut line.
  std::vector<std::string> remarks() const override;
  std::string how() const override;

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  double number(std::size_t column) const;
  void readInstant();

  TableSettings settings_;
  LineReader lines_;
  TableDialect dialect_;
  std::vector<std::size_t> selected_;
  std::vector<std::string_view> cells_;
  std::size_t time_ = kNone;
  double nanoseconds_ = 1.0e9;  // of the unit of the time
  std::int64_t row_ = 0;
  bool left_out_ = false;
};

/// Columns by name and unit, each with a number for every row, of a table of at most 64 MiB. Throws
/// InputError with the line and column of the error, as TableReader and for a gap.
std::vector<std::vector<double>> tableColumns(
    const std::string& path, const std::vector<std::pair<std::string, std::string>>& wanted);

}  // namespace whirl_twin
