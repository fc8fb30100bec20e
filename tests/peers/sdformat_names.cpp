// What sdformat keeps of files: the links and joints by name, and its complaints; an SDF or, as Gazebo reads it, a URDF.
#include <iostream>
#include <sdf/sdf.hh>

static void tell(const sdf::Model &m, const std::string &scope) {
  for (uint64_t i = 0; i < m.LinkCount(); ++i) std::cout << "link " << scope << m.LinkByIndex(i)->Name() << "\n";
  for (uint64_t i = 0; i < m.JointCount(); ++i) std::cout << "joint " << scope << m.JointByIndex(i)->Name() << "\n";
  for (uint64_t i = 0; i < m.ModelCount(); ++i) tell(*m.ModelByIndex(i), scope + m.ModelByIndex(i)->Name() + "::");
}

int main(int n, char **words) {
  for (int i = 1; i < n; ++i) {
    sdf::Root root;
    for (const auto &e : root.Load(words[i])) {
      std::string text = e.Message();
      for (char &c : text) c = c == '\n' ? ' ' : c;
      std::cout << "error " << text << "\n";
    }
    if (root.Model()) tell(*root.Model(), "");
    for (uint64_t w = 0; w < root.WorldCount(); ++w)
      for (uint64_t k = 0; k < root.WorldByIndex(w)->ModelCount(); ++k) tell(*root.WorldByIndex(w)->ModelByIndex(k), "");
  }
}
