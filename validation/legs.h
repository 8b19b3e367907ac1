// The parts of a run that was stopped and gone on with, as its manifest tells them.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

namespace sluice {

/// One part for the manifest's `legs`: the build, machine and threads that the manifest names now, and the time [s]
/// from which on they computed.
nlohmann::json leg_of(const nlohmann::json& manifest, double from_s);

/// In words, in which of these (none given: of all) the legs of a run differ; empty where they do not, or where the
/// manifest has none. What a leg does not state does not differ.
std::string difference_of_legs(const nlohmann::json& manifest, std::initializer_list<const char*> keys = {});

}  // namespace sluice
