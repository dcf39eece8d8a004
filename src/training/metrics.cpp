#include "wordgaze/training/metrics.hpp"

namespace wordgaze::training {
namespace {

struct Column {
  const char* name;
  double Metrics::*member;
};

constexpr Column kColumns[] = {
    {"frames", &Metrics::frames},
    {"seconds", &Metrics::seconds},
    {"success_rate", &Metrics::success_rate},
    {"mean_return", &Metrics::mean_return},
    {"mean_length", &Metrics::mean_length},
    {"policy_loss", &Metrics::policy_loss},
    {"value_loss", &Metrics::value_loss},
    {"mask_loss", &Metrics::mask_loss},
    {"entropy", &Metrics::entropy},
    {"kl", &Metrics::kl},
    {"clip_fraction", &Metrics::clip_fraction},
    {"gradient_norm", &Metrics::gradient_norm},
    {"learning_rate", &Metrics::learning_rate},
    {"task_learning_rate", &Metrics::task_learning_rate},
    {"hit", &Metrics::hit},
    {"hit_12", &Metrics::hit_12},
    {"success_go_to", &Metrics::success_go_to},
    {"success_pickup", &Metrics::success_pickup},
    {"done_wrong", &Metrics::done_wrong},
    {"truncated", &Metrics::truncated},
    {"go_to_share", &Metrics::go_to_share},
    {"skipped", &Metrics::skipped},
};

}  // namespace

std::vector<std::string> Metrics::columns() const {
  std::vector<std::string> names;
  for (const auto& column : kColumns) names.emplace_back(column.name);
  for (const auto& other : others) names.push_back(other.first);
  return names;
}

std::vector<double> Metrics::values() const {
  std::vector<double> row;
  for (const auto& column : kColumns) row.push_back(this->*column.member);
  for (const auto& other : others) row.push_back(other.second);
  return row;
}

}  // namespace wordgaze::training
