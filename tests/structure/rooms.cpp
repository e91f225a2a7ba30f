// SPDX-License-Identifier: MIT
#include "tests/structure/rooms.h"

#include <algorithm>
#include <map>
#include <set>

namespace carom::structure {
namespace {

using Graph = std::map<std::string, std::set<std::string>>;

constexpr std::size_t kMostRooms = 2;

std::string roomOf(const std::string& path) { return path.substr(0, path.rfind('.')); }

Graph graphOf(const Sources& sources) {
  Graph graph;
  for (const auto& [path, text] : sources) {
    std::set<std::string>& to = graph[roomOf(path)];
    for (const std::string& written : includesOf(text)) {
      const std::string include = resolved(path, written);
      if (sources.contains(include) && roomOf(include) != roomOf(path)) to.insert(roomOf(include));
    }
  }
  return graph;
}

// Strongly connected components, by Tarjan (SIAM Journal on Computing 1(2), 1972).
class Components {
 public:
  explicit Components(const Graph& graph) : graph_(graph) {
    for (const auto& [room, to] : graph)
      if (!index_.contains(room)) visit(room);
  }
  std::vector<std::vector<std::string>> found;

 private:
  void visit(const std::string& room) {
    const int own = next_++;
    index_[room] = low_[room] = own;
    stack_.push_back(room);
    on_stack_.insert(room);
    for (const std::string& to : graph_.at(room)) {
      if (!index_.contains(to)) {
        visit(to);
        low_[room] = std::min(low_[room], low_[to]);
      } else if (on_stack_.contains(to)) {
        low_[room] = std::min(low_[room], index_[to]);
      }
    }
    if (low_[room] != own) return;
    std::vector<std::string> component;
    do {
      component.push_back(stack_.back());
      on_stack_.erase(stack_.back());
      stack_.pop_back();
    } while (component.back() != room);
    std::sort(component.begin(), component.end());
    found.push_back(std::move(component));
  }

  const Graph& graph_;
  std::map<std::string, int> index_, low_;
  std::vector<std::string> stack_;
  std::set<std::string> on_stack_;
  int next_ = 0;
};

}  // namespace

std::vector<std::vector<std::string>> circles(const Sources& sources) {
  const Graph graph = graphOf(sources);
  std::vector<std::vector<std::string>> all = Components(graph).found;
  std::erase_if(all, [](const auto& component) { return component.size() < 2; });
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return all;
}

std::vector<std::string> circleViolations(const Sources& sources) {
  static const std::set<std::string> product = {"adjoint", "ode_bridge", "editing", "formats", "explore", "cli"};
  std::vector<std::string> violations;
  for (const std::vector<std::string>& circle : circles(sources)) {
    if (circle.size() <= kMostRooms || !product.contains(folderOf(circle.front()))) continue;
    std::string sentence = "a circle of " + std::to_string(circle.size()) + " rooms:";
    for (const std::string& room : circle) sentence += " " + room;
    violations.push_back(std::move(sentence));
  }
  return violations;
}

}  // namespace carom::structure
