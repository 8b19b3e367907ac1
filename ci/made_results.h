// Results made by hand, for tests and for looking at a page without a year of nights.
#pragma once

#include <string>

#include "ci/ledger.h"

namespace sluice::ci::made {

/// 2026-01-01T03:00:00Z and so many days later.
std::string night(int days);

/// A result of the run of one night: case kleefsman, WCSPH, at commit "c" and the night's number.
Result result(int days, const std::string& metric, const std::string& of, double value, const std::string& unit = "1");

/// Eighty nights of both solvers at two resolutions, with a step for the worse in MPS, one that is accepted, one for
/// the better, a value that goes missing, and a benchmark: something of everything that a page can show.
Ledger example();

}  // namespace sluice::ci::made
