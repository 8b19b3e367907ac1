#include "solvers/mps/particles.h"

#include "solvers/encode_positions.h"

namespace sluice::mps {

template <class Pack>
void Particles<Pack>::resize(std::size_t dummy_count, std::size_t wall_count, std::size_t fluid_count) {
  dummies = dummy_count;
  walls = wall_count;
  fluid = fluid_count;
  position.resize(size());
  coordinate.resize(size() + Lanes<Pack>::width);  // packs read past a run's end
  velocity.resize(size());
  pressure.resize(size());
  number_density.resize(size());
  centroid_offset.resize(size());
  id.resize(size());
}

template <class Pack>
void Particles<Pack>::permute_fluid(std::span<const std::int32_t> order, int threads) {
  gather(position, order, spare_doubles_, threads, first_fluid());
  gather(velocity, order, spare_values_, threads, first_fluid());
  gather(pressure, order, spare_doubles_, threads, first_fluid());
  gather(id, order, spare_ids_, threads, first_fluid());
  if (order.size() != fluid) resize(dummies, walls, order.size());
}

template <class Pack>
void Particles<Pack>::permute(std::size_t first, std::span<const std::int32_t> from) {
  const auto apply = [&](auto& values) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector moved(begin, begin + static_cast<std::ptrdiff_t>(from.size()));
    for (std::size_t k = 0; k < from.size(); ++k) values[first + k] = moved[static_cast<std::size_t>(from[k])];
  };
  const auto apply_to_field = [&](auto& field) {
    apply(field.x);
    apply(field.y);
    apply(field.z);
  };
  apply_to_field(position);
  apply_to_field(velocity);
  apply(pressure);
  apply(id);
}

template <class Pack>
void Particles<Pack>::encode_positions(const Box& domain, std::size_t first, int threads) {
  const auto parts = static_cast<std::size_t>(threads);
  const std::size_t n = size() - first;
#pragma omp parallel for num_threads(threads) schedule(static)
  for (int t = 0; t < threads; ++t) {
    const auto part = static_cast<std::size_t>(t);
    sluice::encode_positions(position, domain, first + n * part / parts, first + n * (part + 1) / parts, coordinate);
  }
}

template <class Pack>
std::int64_t Particles<Pack>::memory_bytes() const {
  return bytes(position) + bytes(coordinate) + bytes(velocity) + bytes(pressure) + bytes(number_density) +
         bytes(centroid_offset) + bytes(id) + bytes(spare_doubles_) + bytes(spare_values_) + bytes(spare_ids_);
}

template struct Particles<double>;
template struct Particles<FloatPack>;

}  // namespace sluice::mps
