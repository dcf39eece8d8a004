#pragma once
#include <string>
#include <string_view>

namespace wordgaze::lcm_io {

/// The multicast group of an LCM URL of the form udpm://[group[:port]][?ttl=n][&recv_buf_size=n],
/// LCM's own where none is written. Throws std::invalid_argument for every other text and says what
/// is expected: LCM itself passes over what it does not understand.
std::string multicast_group(std::string_view url);

}  // namespace wordgaze::lcm_io
