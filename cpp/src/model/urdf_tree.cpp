#include "thing_kin/model/urdf_tree.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

[[noreturn]] void refuse(const std::string& got, const std::string& expected) {
  throw InvalidArgument("source", got, expected);
}

// 'a', 'b', ...: the first twenty.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    text.append(i == 0 ? "" : ", ").append(quoted(names[i]));
  }
  const std::size_t more = names.size() - std::min(names.size(), kMost);
  return more == 0 ? text : text.append(" and ").append(std::to_string(more)).append(" more");
}

class Tree {
 public:
  explicit Tree(const UrdfDocument& document) : document_(document) {
    add_links();
    add_joints();
    find_root();
    check_cycles();
  }

  const std::string& root() const { return root_; }

  void check_link(const std::string& name, const char* argument) const {
    if (!links_.contains(name)) {
      throw InvalidArgument(argument, quoted(name), "one of the links " + listed(document_.links));
    }
  }

  // From a link up to the root, the joints above each.
  std::vector<const UrdfJoint*> above(const std::string& link) const {
    std::vector<const UrdfJoint*> joints;
    for (auto at = parent_.find(link); at != parent_.end(); at = parent_.find(at->second->parent)) {
      joints.push_back(at->second);
    }
    return joints;
  }

  // The links without children below `base`, in the order of the file.
  std::vector<std::string> leaves(const std::string& base) const {
    std::vector<std::string> leaves;
    const std::set<std::string> below = all_below(base);
    std::ranges::copy_if(document_.links, std::back_inserter(leaves), [&](const auto& link) {
      return below.contains(link) && !children_.contains(link);
    });
    return leaves;
  }

 private:
  void add_links() {
    for (const std::string& link : document_.links) {
      if (link.empty()) {
        refuse("a link without a name", "a name for each link");
      }
      if (!links_.insert(link).second) {
        refuse(std::string("two links ").append(quoted(link)), "unique names");
      }
    }
    if (links_.empty()) {
      refuse("a robot without links", "at least one link");
    }
  }

  void add_joints() {
    std::set<std::string> names;
    for (const UrdfJoint& joint : document_.joints) {
      if (joint.name.empty()) {
        refuse("a joint without a name", "a name for each joint");
      }
      if (!names.insert(joint.name).second) {
        refuse(std::string("two joints ").append(quoted(joint.name)), "unique names");
      }
      check_end(joint, "parent", joint.parent);
      check_end(joint, "child", joint.child);
      if (!parent_.emplace(joint.child, &joint).second) {
        refuse(std::string("link ").append(quoted(joint.child)).append(" with two parents"),
               "a tree, where each link has one");
      }
      children_[joint.parent].push_back(joint.child);
    }
  }

  void check_end(const UrdfJoint& joint, const std::string& end, const std::string& link) const {
    if (!links_.contains(link)) {
      std::string got = std::string("joint ").append(quoted(joint.name));
      got.append(link.empty() ? " without a " : " with ").append(end);
      refuse(link.empty() ? got : got.append(" ").append(quoted(link)).append(", which is no link"),
             "a parent and a child that are links of the robot");
    }
  }

  void find_root() {
    std::vector<std::string> roots;
    std::ranges::copy_if(document_.links, std::back_inserter(roots),
                         [&](const auto& link) { return !parent_.contains(link); });
    if (roots.empty()) {
      refuse("a cycle of joints without a root link", "a tree");
    }
    if (roots.size() > 1) {
      refuse(std::to_string(roots.size()).append(" root links: ").append(listed(roots)), "one");
    }
    root_ = roots.front();
  }

  void check_cycles() const {
    const std::set<std::string> reached = all_below(root_);
    for (const std::string& link : document_.links) {
      if (!reached.contains(link)) {
        refuse(std::string("a cycle of joints through link ").append(quoted(link)), "a tree");
      }
    }
  }

  // Without recursion: a file may be a chain of a million links.
  std::set<std::string> all_below(const std::string& link) const {
    std::set<std::string> below{link};
    std::vector<std::string> open{link};
    while (!open.empty()) {
      const auto children = children_.find(open.back());
      open.pop_back();
      if (children == children_.end()) {
        continue;
      }
      for (const std::string& child : children->second) {
        if (below.insert(child).second) {
          open.push_back(child);
        }
      }
    }
    return below;
  }

  const UrdfDocument& document_;
  std::set<std::string> links_;
  std::map<std::string, const UrdfJoint*> parent_;
  std::map<std::string, std::vector<std::string>> children_;
  std::string root_;
};

std::string only_leaf(const Tree& tree, const std::string& base) {
  const std::vector<std::string> leaves = tree.leaves(base);
  if (leaves.size() > 1) {
    throw InvalidArgument("tip", "none",
                          std::string("one of the robot's links, for ")
                              .append(quoted(base))
                              .append(" leads to ")
                              .append(std::to_string(leaves.size()))
                              .append(" leaves: ")
                              .append(listed(leaves)));
  }
  return leaves.front();
}

}  // namespace

UrdfPath find_urdf_path(const UrdfDocument& document, const std::string& base,
                        const std::string& tip) {
  const Tree tree(document);
  UrdfPath path{base.empty() ? tree.root() : base, tip, {}};
  tree.check_link(path.base, "base");
  if (tip.empty()) {
    path.tip = only_leaf(tree, path.base);
  }
  tree.check_link(path.tip, "tip");
  std::vector<const UrdfJoint*> up = tree.above(path.base);
  std::vector<const UrdfJoint*> down = tree.above(path.tip);
  while (!up.empty() && !down.empty() && up.back() == down.back()) {  // above the common ancestor
    up.pop_back();
    down.pop_back();
  }
  for (const UrdfJoint* joint : up) {
    path.steps.push_back({joint, true});
  }
  std::ranges::for_each(down.rbegin(), down.rend(),
                        [&](const UrdfJoint* joint) { path.steps.push_back({joint, false}); });
  return path;
}

}  // namespace thing_kin
