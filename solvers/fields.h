// Values of many particles, one array a component, and what is done with whole arrays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/vec3.h"

namespace sluice {

template <class T>
struct VectorField {
  std::vector<T> x;
  std::vector<T> y;
  std::vector<T> z;

  void resize(std::size_t n) {
    x.resize(n);
    y.resize(n);
    z.resize(n);
  }
  void swap(VectorField& o) {
    x.swap(o.x);
    y.swap(o.y);
    z.swap(o.z);
  }
  template <class S>
  Vec3<S> at(std::size_t i) const {
    return {S(x[i]), S(y[i]), S(z[i])};
  }
  template <class S>
  void set(std::size_t i, const Vec3<S>& v) {
    x[i] = static_cast<T>(v.x);
    y[i] = static_cast<T>(v.y);
    z[i] = static_cast<T>(v.z);
  }
};

/// values[first + k] = values[first + order[k]], through a spare array that takes the old one's place; values before
/// `first` stay.
template <class T>
void gather(std::vector<T>& values, std::span<const std::int32_t> order, std::vector<T>& spare, int threads,
            std::size_t first = 0) {
  spare.resize(values.size());
  const auto kept = static_cast<std::int64_t>(first);
  const auto n = static_cast<std::int64_t>(order.size());
#pragma omp parallel num_threads(threads)
  {
#pragma omp for schedule(static) nowait
    for (std::int64_t k = 0; k < kept; ++k) spare[static_cast<std::size_t>(k)] = values[static_cast<std::size_t>(k)];
#pragma omp for schedule(static)
    for (std::int64_t k = 0; k < n; ++k) {
      spare[first + static_cast<std::size_t>(k)] =
          values[first + static_cast<std::size_t>(order[static_cast<std::size_t>(k)])];
    }
  }
  values.swap(spare);
}

template <class T>
void gather(VectorField<T>& field, std::span<const std::int32_t> order, std::vector<T>& spare, int threads,
            std::size_t first = 0) {
  gather(field.x, order, spare, threads, first);
  gather(field.y, order, spare, threads, first);
  gather(field.z, order, spare, threads, first);
}

/// gathered[k] = field[order[k]]
template <class T>
void gather(const VectorField<T>& field, std::span<const std::int32_t> order, VectorField<T>& gathered) {
  gathered.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    gathered.set(k, field.template at<T>(static_cast<std::size_t>(order[k])));
}

template <class T>
std::int64_t bytes(const std::vector<T>& v) {
  return static_cast<std::int64_t>(v.capacity() * sizeof(T));
}
template <class T>
std::int64_t bytes(const VectorField<T>& f) {
  return bytes(f.x) + bytes(f.y) + bytes(f.z);
}

}  // namespace sluice
