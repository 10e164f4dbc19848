#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

/// Makes names unique: the second element of a name gets "_2". glTF lets cameras or animations share a name, and nodes
/// share a camera.
template <class Named>
void make_names_unique(std::vector<Named>& list) {
    std::set<std::string> taken;
    std::map<std::string, int> count;
    for (Named& named : list) {
        const std::string name = named.name;
        int& number = count[name];
        while (!taken.insert(named.name).second) named.name = name + "_" + std::to_string(++number + 1);
    }
}
