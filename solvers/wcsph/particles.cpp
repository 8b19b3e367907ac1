#include "solvers/wcsph/particles.h"

#include "solvers/encode_positions.h"

namespace sluice::wcsph {
template <class Pack>
void Particles<Pack>::resize(std::size_t count) {
  n = count;
  const std::size_t padded = count + Lanes<Pack>::width;
  position.resize(count);
  velocity_previous.resize(count);
  density_previous.resize(count);
  id.resize(count);
  acceleration.resize(padded);
  density_rate.resize(padded);
  velocity.resize(padded);
  density.resize(padded);
  coordinate.resize(padded);
  pressure.resize(padded);
  volume.resize(padded);
  sound.resize(padded);
}

template <class Pack>
void Particles<Pack>::permute(std::span<const std::int32_t> order, int threads) {
  gather(position, order, spare_positions_, threads);
  gather(velocity, order, spare_values_, threads);
  gather(velocity_previous, order, spare_values_, threads);
  gather(density, order, spare_values_, threads);
  gather(density_previous, order, spare_values_, threads);
  gather(id, order, spare_ids_, threads);
  if (order.size() != n) resize(order.size());
}

template <class Pack>
void Particles<Pack>::encode_positions(const Box& domain, std::size_t first, std::size_t last) {
  sluice::encode_positions(position, domain, first, last, coordinate);
}

template <class Pack>
std::int64_t Particles<Pack>::memory_bytes() const {
  return bytes(position) + bytes(velocity) + bytes(velocity_previous) + bytes(density) + bytes(density_previous) +
         bytes(id) + bytes(coordinate) + bytes(pressure) + bytes(volume) + bytes(sound) + bytes(acceleration) +
         bytes(density_rate) + bytes(spare_positions_) + bytes(spare_values_) + bytes(spare_ids_);
}

template struct Particles<double>;
template struct Particles<FloatPack>;

}  // namespace sluice::wcsph
