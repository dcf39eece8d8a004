#pragma once
#include <nlohmann/json.hpp>

#include "wordgaze/evaluation/decision_observer.hpp"

namespace wordgaze::page {

/// What the policy would be without one cell of the view, and without one word of the mission: for
/// each cell with something in it and for each word the probabilities of all actions.
///
///     {"cells": {"23": "base64"}, "words": ["base64", ...]}
nlohmann::ordered_json what_if(const evaluation::DecisionContext& context);

}  // namespace wordgaze::page
