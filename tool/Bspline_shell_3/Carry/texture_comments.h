// Comments that name the textures of a PLY file.
#ifndef TOOL_CARRY_TEXTURE_COMMENTS_H
#define TOOL_CARRY_TEXTURE_COMMENTS_H

#include "../Files/Model.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace Tool {

const std::string texture_comment = "comment TextureFile "; // precedes the name of a file

inline bool is_texture_comment(const std::string& comment)
{
  return comment.compare(0, texture_comment.size(), texture_comment) == 0;
}

inline std::vector<std::string> texture_comments(const Model& model)
{
  std::vector<std::string> found;
  std::copy_if(model.comments.begin(), model.comments.end(), std::back_inserter(found), is_texture_comment);
  return found;
}

// Replaces these comments of a model.
inline void set_texture_comments(Model& model, const std::vector<std::string>& comments)
{
  auto& all = model.comments;
  all.erase(std::remove_if(all.begin(), all.end(), is_texture_comment), all.end());
  all.insert(all.end(), comments.begin(), comments.end());
}

} // namespace Tool

#endif // TOOL_CARRY_TEXTURE_COMMENTS_H
