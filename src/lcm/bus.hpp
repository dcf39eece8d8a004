#pragma once
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

namespace wordgaze::lcm_io {

/// Why packets to the group of a URL have no way out, and which command helps; empty when they have
/// one. LCM itself would only print and open nothing. Throws std::invalid_argument for what is not
/// a URL of udpm (url.hpp).
std::string missing_route(const std::string& url);

/// Throws std::invalid_argument when LCM cannot open a URL that has a route.
std::shared_ptr<lcm::LCM> open_bus(const std::string& url);

}  // namespace wordgaze::lcm_io
