// Compressed rows that several threads fill at once. Every row says where it begins and ends, so that rows may lie in
// memory in any order: what a row holds does not depend on which thread wrote it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "solvers/fields.h"

namespace sluice::mps {

/// Rows are filled up to a multiple of this with entries of value zero, so that loops over them need no remainder. Two
/// sums side by side hide enough latency; more only add zeros to read.
constexpr std::size_t row_unit = 2;

/// A part of one row: entries begin .. end - 1.
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

template <class Real>
class SparseRows {
 public:
  void reserve(std::size_t rows, std::size_t entries) {
    spans_.resize(rows);
    if (overread + entries > room()) resize(overread + entries);
  }
  /// For a filling anew: rows that it does not write stay as they are, new ones are empty.
  void clear(std::size_t rows) {
    spans_.resize(rows);
    used_ = overread;
  }
  /// Makes room for a quarter more than the last filling took, if that did not fit: then it must be repeated. True if
  /// so.
  bool grew_for_more() {
    if (used_.load() <= room()) return false;
    const std::size_t wanted = used_.load() + used_.load() / 4;
    resize(wanted);
    return true;
  }

  Span& span(std::size_t row) { return spans_[row]; }
  const Span& span(std::size_t row) const { return spans_[row]; }
  const std::vector<Span>& spans() const { return spans_; }
  const std::int32_t* columns() const { return columns_.data(); }
  const Real* values() const { return values_.data(); }
  std::int64_t memory_bytes() const { return bytes(spans_) + bytes(columns_) + bytes(values_); }

  /// Hands out room for rows to one thread.
  class Writer {
   public:
    explicit Writer(SparseRows& rows) : rows_(rows) {}
    /// Writes one row, entries from `begin` on first; without room it only counts what was needed. Whole units may be
    /// read from the row's first entry on, or from what `begin` has become.
    void write(std::size_t row, const std::int32_t* columns, const Real* values, std::size_t count) {
      write(row, columns, values, count, count);
    }
    void write(std::size_t row, const std::int32_t* columns, const Real* values, std::size_t count, std::size_t begin) {
      const std::size_t beyond = begin < count ? row_unit : 0;
      const std::size_t filled = (count + beyond + row_unit - 1) / row_unit * row_unit;
      if (next_ + filled > last_) {
        const std::size_t block = std::max<std::size_t>(filled, 4096);
        next_ = rows_.used_.fetch_add(block);
        last_ = next_ + block;
      }
      if (last_ <= rows_.room()) {
        std::rotate_copy(columns, columns + begin, columns + count, rows_.columns_.data() + next_);
        std::rotate_copy(values, values + begin, values + count, rows_.values_.data() + next_);
        std::fill_n(rows_.columns_.begin() + static_cast<std::ptrdiff_t>(next_ + count), filled - count,
                    static_cast<std::int32_t>(row));
        std::fill_n(rows_.values_.begin() + static_cast<std::ptrdiff_t>(next_ + count), filled - count, Real{});
        rows_.spans_[row] = {static_cast<std::uint32_t>(next_), static_cast<std::uint32_t>(next_ + count)};
      }
      next_ += filled;
    }

   private:
    SparseRows& rows_;
    std::size_t next_ = overread;  ///< of empty rows before the first block, too: packs may read before them
    std::size_t last_ = overread;
  };

 private:
  static constexpr std::size_t overread = 64;  ///< packs may read past the last entry, and before the first

  std::size_t room() const { return columns_.empty() ? 0 : columns_.size() - overread; }
  void resize(std::size_t room) {
    if (room + overread > std::numeric_limits<std::uint32_t>::max())
      throw std::length_error("more than 4.2 billion pairs of neighbours, too many to index: choose a larger l0");
    columns_.resize(room + overread);
    values_.resize(room + overread);
  }

  std::vector<Span> spans_;
  std::vector<std::int32_t> columns_;
  std::vector<Real> values_;
  std::atomic<std::size_t> used_{overread};
};

}  // namespace sluice::mps
