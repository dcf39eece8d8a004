#pragma once
#include <string>
#include <string_view>

namespace wordgaze::lcm_io {

/// Who is sending: goes into the messages that begin an episode or report an update.
struct Origin {
  std::string run_id;      ///< joins episodes and metrics of one run
  std::string checkpoint;  ///< file of the weights; empty while training
};

inline constexpr std::string_view kEpisodeBeginChannel = "WORDGAZE_EPISODE_BEGIN";
inline constexpr std::string_view kWorldChannel = "WORDGAZE_WORLD";
inline constexpr std::string_view kProgressChannel = "WORDGAZE_PROGRESS";
inline constexpr std::string_view kStepChannel = "WORDGAZE_STEP";
inline constexpr std::string_view kEpisodeEndChannel = "WORDGAZE_EPISODE_END";
inline constexpr std::string_view kMetricsChannel = "WORDGAZE_METRICS";
inline constexpr std::string_view kPolicyRequestChannel = "WORDGAZE_POLICY_REQUEST";
inline constexpr std::string_view kPolicyReplyChannel = "WORDGAZE_POLICY_REPLY";

}  // namespace wordgaze::lcm_io
