#include "wordgaze/model/agent.hpp"

#include "wordgaze/policy/network_policy.hpp"

template struct wordgaze::model::Agent<float>;
template class wordgaze::policy::NetworkPolicy<wordgaze::policy::Agent>;
