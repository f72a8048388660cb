-- What a page needs beyond plain Markdown, for HTML and for Typst alike.
local page = nil

local function is_typst() return FORMAT:match("typst") ~= nil end

function Meta(meta)
  page = pandoc.utils.stringify(meta.page)
end

-- Numbers of equations stand after them: neither MathML nor Typst knows \tag.
function Math(math)
  math.text = math.text:gsub("%s*\\tag{(.-)}", "\\qquad\\text{(%1)}")
  return math
end

-- Headings keep apart when all pages become one document: the first bears the name of its page.
local first = true
function Header(header)
  if first then
    header.identifier, first = page, false
  elseif is_typst() then
    header.identifier = page .. "-" .. header.identifier
  end
  return header
end

-- A figure among the results is one of the report's own.
local function figure(target)
  return target:match("^%.%./results/%w+/([%w_]+)%.%w+$")
end

function Image(image)
  local name = figure(image.src)
  if name then image.src = "figures/" .. name .. ".svg" end
  return image
end

-- Links between documents become links between pages, or between chapters of the one document.
function Link(link)
  if is_typst() and link.target:sub(1, 1) == "#" then
    link.target = "#" .. page .. "-" .. link.target:sub(2)
    return link
  end
  local picture = figure(link.target)
  if picture then
    if is_typst() then return link.content end
    link.target = "figures/" .. picture .. ".svg"
    return link
  end
  local name, anchor = link.target:match("^([%w_]+)%.md(#?.*)$")
  if not name then name, anchor = link.target:match("^([%w_]+)%.html(#?.*)$") end
  if not name then return nil end
  if is_typst() then
    link.target = "#" .. name .. (anchor ~= "" and "-" .. anchor:sub(2) or "")
  else
    link.target = name .. ".html" .. anchor
  end
  return link
end

-- A wide table scrolls by itself, and can be reached by keyboard.
function Table(tbl)
  if is_typst() then return nil end
  return pandoc.Div({ tbl }, pandoc.Attr("", { "scroll" }, { tabindex = "0", role = "region", ["aria-label"] = "Table" }))
end

return { { Meta = Meta }, { Math = Math, Header = Header, Link = Link, Image = Image, Table = Table } }
