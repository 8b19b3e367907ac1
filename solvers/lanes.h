// One pair at a time in double precision, or a vector of pairs in single precision: the two number types for which
// every pair term of the solvers is instantiated, behind the same few operations.
//
// Positions are kept in double precision. The vector path works on a copy in 32-bit fixed point (see FixedPoint): its
// differences are exact integers wherever in the domain a pair lies, so that nothing is lost far from the origin.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <experimental/simd>

namespace sluice {

namespace stdx = std::experimental;

/// The fast path's pack: as many single-precision lanes as the machine's registers hold.
using FloatPack = stdx::native_simd<float>;

template <class Pack>
struct Lanes;

/// Reference path: one lane of double precision.
template <>
struct Lanes<double> {
  using Real = double;        ///< type of stored particle values
  using Coordinate = double;  ///< type of stored pair coordinates
  static constexpr int width = 1;

  static double load(const double* p) { return *p; }
  static double difference(const double* to, double from) { return *to - from; }
  template <class T>
  static double gather(const T* values, const std::int32_t* index) {
    return static_cast<double>(values[*index]);
  }
  static double difference_at(const double* to, const std::int32_t* index, double from) { return to[*index] - from; }
  template <class T>
  static T joined(const T* a, int n, const T* b) {
    return n > 0 ? *a : *b;
  }
  static std::int32_t with_repeats(std::int32_t index, int) { return index; }
  static void store(std::int32_t v, std::int32_t* p) { *p = v; }
  static std::int32_t load(const std::int32_t* p) { return *p; }
  static void store(double v, double* p) { *p = v; }
  static void store_between(double v, double low, double high, std::int32_t* p) { *p = v > low && v < high; }
  static double first(int) { return 1; }
  using Window = int;
  static Window window(int n) { return n; }
  static void add(double* p, double v, Window) { *p += v; }
};

/// Fast path: a pack of single precision.
template <>
struct Lanes<FloatPack> {
  using Real = float;
  using Coordinate = std::int32_t;
  using Integers = stdx::rebind_simd_t<std::int32_t, FloatPack>;
  using Unsigned = stdx::rebind_simd_t<std::uint32_t, FloatPack>;
  static constexpr int width = FloatPack::size();

  [[gnu::always_inline]] static FloatPack load(const float* p) { return FloatPack(p, stdx::element_aligned); }
  [[gnu::always_inline]] static void store(FloatPack v, float* p) { v.copy_to(p, stdx::element_aligned); }
  /// One for each lane with low < v < high, zero for the others.
  [[gnu::always_inline]] static void store_between(FloatPack v, float low, float high, std::int32_t* p) {
    FloatPack flag{};
    stdx::where(v > low && v < high, flag) = 1.0F;
    stdx::static_simd_cast<Integers>(flag).copy_to(p, stdx::element_aligned);
  }

  /// to - from in quanta for a whole pack; the integer difference is exact, its conversion rounds to single precision.
  [[gnu::always_inline]] static FloatPack difference(const std::int32_t* to, std::int32_t from) {
    // Unsigned, since lanes past a run's end may lie anywhere in the domain and wrap around; they are masked
    // afterwards.
    const Unsigned wrapped = Unsigned(reinterpret_cast<const std::uint32_t*>(to), stdx::element_aligned) -
                             Unsigned(static_cast<std::uint32_t>(from));
    return stdx::static_simd_cast<FloatPack>(stdx::static_simd_cast<Integers>(wrapped));
  }

  /// values[index[k]] in lane k.
  template <class T>
  [[gnu::always_inline]] static FloatPack gather(const T* values, const std::int32_t* index) {
    std::array<float, width> v;
    for (std::size_t k = 0; k < width; ++k) v[k] = static_cast<float>(values[index[k]]);
    return load(v.data());
  }
  /// to[index[k]] - from in quanta, as `difference`.
  [[gnu::always_inline]] static FloatPack difference_at(const std::int32_t* to, const std::int32_t* index,
                                                        std::int32_t from) {
    std::array<std::int32_t, width> v;
    for (std::size_t k = 0; k < width; ++k) v[k] = to[index[k]];
    return difference(v.data(), from);
  }
  /// Lanes 0 .. n - 1 are a's, the others b[0], b[1] and so on. Reads a whole pack from a and one from n before b.
  [[gnu::always_inline]] static FloatPack joined(const float* a, int n, const float* b) {
    FloatPack pack = load(b - n);
    if (n > 0) stdx::where(first(n) > FloatPack{}, pack) = load(a);
    return pack;
  }
  [[gnu::always_inline]] static Integers joined(const std::int32_t* a, int n, const std::int32_t* b) {
    Integers pack = load(b - n);
    if (n > 0) stdx::where(first_integers(n) > Integers{}, pack) = load(a);
    return pack;
  }
  /// Lanes from n on repeat the first.
  [[gnu::always_inline]] static Integers with_repeats(Integers index, int n) {
    Integers repeated = index[0];
    stdx::where(first_integers(n) > Integers{}, repeated) = index;
    return repeated;
  }
  [[gnu::always_inline]] static Integers load(const std::int32_t* p) { return Integers(p, stdx::element_aligned); }
  [[gnu::always_inline]] static void store(Integers v, std::int32_t* p) { v.copy_to(p, stdx::element_aligned); }

  /// One in the first n lanes (0 < n <= width), zero in the others: a window that slides over ones and zeros.
  [[gnu::always_inline]] static FloatPack first(int n) {
    return load(&ones_then_zeros[static_cast<std::size_t>(width - n)]);
  }

  /// The first n lanes of a pack.
  struct Window {
    FloatPack::mask_type inside;
    int n;
  };
  [[gnu::always_inline]] static Window window(int n) { return {first(n) > FloatPack{}, n}; }

  /// Adds the lanes of a window to memory; the memory behind them is not written. It is read whole, though
  /// another thread may write there: what those lanes hold is dropped. AVX-512 stores under a mask as
  /// fast as without; AVX2's masked stores are long microprograms on some processors (a Zen 1 spends a third of a time
  /// step in them), so that what is whole is stored whole.
  [[gnu::always_inline]] static void add(float* p, FloatPack v, const Window& window) {
    const FloatPack sum = load(p) + v;
    if (width <= 8 && window.n == width) {
      store(sum, p);
    } else if constexpr (width > 4) {
      stdx::where(window.inside, sum).copy_to(p, stdx::element_aligned);
    } else {
      // SSE2's masked store goes past the caches: with it all of a step took 20 times as long.
      std::array<float, width> values;
      store(sum, values.data());
      std::copy_n(values.begin(), window.n, p);
    }
  }

 private:
  [[gnu::always_inline]] static Integers first_integers(int n) { return stdx::static_simd_cast<Integers>(first(n)); }

  static constexpr std::array<float, 2 * width> ones_then_zeros = [] {
    std::array<float, 2 * width> a{};
    for (std::size_t k = 0; k < width; ++k) a[k] = 1;
    return a;
  }();
};

// The same names for one lane and for a pack.
inline double square_root(double a) {
  return std::sqrt(a);
}
inline double magnitude(double a) {
  return std::abs(a);
}
inline double larger(double a, double b) {
  return std::max(a, b);
}
inline double smaller(double a, double b) {
  return std::min(a, b);
}
/// Whether a > b in any lane where `where` is positive.
inline bool any_larger(double a, double b, double where) {
  return a > b && where > 0;
}
/// a where `where` is positive, else zero.
inline double where_positive(double where, double a) {
  return where > 0 ? a : 0;
}
inline double lane_sum(double a) {
  return a;
}
inline double lane_max(double a) {
  return a;
}

[[gnu::always_inline]] inline FloatPack square_root(FloatPack a) {
  return stdx::sqrt(a);
}
[[gnu::always_inline]] inline FloatPack magnitude(FloatPack a) {
  return stdx::abs(a);
}
[[gnu::always_inline]] inline FloatPack larger(FloatPack a, FloatPack b) {
  return stdx::max(a, b);
}
[[gnu::always_inline]] inline FloatPack smaller(FloatPack a, FloatPack b) {
  return stdx::min(a, b);
}
[[gnu::always_inline]] inline bool any_larger(FloatPack a, FloatPack b, FloatPack where) {
  return stdx::any_of(a > b && where > FloatPack{});
}
[[gnu::always_inline]] inline FloatPack where_positive(FloatPack where, FloatPack a) {
  FloatPack r{};
  stdx::where(where > r, r) = a;
  return r;
}
inline float lane_sum(FloatPack a) {
  return stdx::reduce(a);
}
inline float lane_max(FloatPack a) {
  return stdx::hmax(a);
}

/// Maps metres to the 32-bit fixed point of the fast path (or leaves them as they are in the reference path).
/// The quantum is the domain's longest edge over 2^32 - 2^20, so pair differences are exact to 1e-9 m in domains up
/// to 4.2 m.
template <class Coordinate>
class FixedPoint;

template <>
class FixedPoint<double> {
 public:
  FixedPoint(double, double) {}
  double encode(double x_m) const { return x_m; }
  static double quantum_m(double) { return 1.0; }
};

template <>
class FixedPoint<std::int32_t> {
 public:
  /// Covers lower .. lower + extent [m].
  FixedPoint(double lower_m, double extent_m)
      : centre_m_(lower_m + 0.5 * extent_m), quanta_per_m_(1.0 / quantum_m(extent_m)) {}
  std::int32_t encode(double x_m) const {
    return static_cast<std::int32_t>(std::lrint((x_m - centre_m_) * quanta_per_m_));
  }
  /// The unit of the coordinates [m] for a domain of this extent.
  static double quantum_m(double extent_m) { return extent_m / (4294967296.0 - 1048576.0); }

 private:
  double centre_m_;
  double quanta_per_m_;
};

}  // namespace sluice
