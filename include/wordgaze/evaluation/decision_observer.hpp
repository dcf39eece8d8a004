#pragma once
#include <vector>

#include "wordgaze/env/environment.hpp"
#include "wordgaze/policy/policy.hpp"

namespace wordgaze::evaluation {

/// A decision that has been taken and not yet carried out; the policy can still be asked about it.
struct DecisionContext {
  policy::Policy& policy;
  int lane;
  const env::Environment& environment;
  const policy::Observation& observation;
  const policy::Decision& decision;
};

/// Looks into each decision of an evaluation. Called from one thread, in order. (A
/// policy::Observer is told what happened; this one sees the network at work.)
class DecisionObserver {
 public:
  virtual ~DecisionObserver() = default;
  virtual void on_decision(const DecisionContext& context) = 0;
};

/// Several of them as one; they must outlive this.
class DecisionObservers final : public DecisionObserver {
 public:
  void add(DecisionObserver* observer) {
    if (observer != nullptr) all_.push_back(observer);
  }
  DecisionObserver* or_null() { return all_.empty() ? nullptr : this; }

  void on_decision(const DecisionContext& context) override {
    for (DecisionObserver* o : all_) o->on_decision(context);
  }

 private:
  std::vector<DecisionObserver*> all_;
};

}  // namespace wordgaze::evaluation
