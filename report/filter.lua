-- What a page needs beyond plain Markdown, for HTML and for Typst alike.
local page = nil

local function is_typst() return FORMAT:match("typst") ~= nil end

function Meta(meta)
  page = pandoc.utils.stringify(meta.page)
end

-- Bars come in pairs; told apart, they are set as the delimiters they are and not as relations.
local function paired(text, bar, left, right)
  local _, count = text:gsub(bar, "")
  if count % 2 == 1 then return text end
  local opening = false
  return (text:gsub(bar, function()
    opening = not opening
    return opening and left or right
  end))
end

function Math(math)
  -- Numbers of equations stand after them: neither MathML nor Typst knows \tag.
  local text = math.text:gsub("%s*\\tag{(.-)}", "\\qquad\\text{(%1)}")
  if not text:find("\\[a-zA-Z]+|") then
    text = paired(paired(text, "\\|", "\\lVert ", "\\rVert "), "|", "\\left| ", "\\right| ")
  end
  text = text:gsub("\\lvert", "\\left|"):gsub("\\rvert", "\\right|")
  math.text = text
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

function Span(span)
  if is_typst() and span.identifier ~= "" then span.identifier = page .. "-" .. span.identifier end
  return span
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
  -- No page of the report leads outside, least of all to a program.
  if link.target:match("^%s*%a[%w+.-]*:") then return link.content end
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

-- In HTML a wide table scrolls by itself, and can be reached by keyboard. On paper its columns share the width by what
-- they hold, since equal shares would leave long text in a narrow one.
local LINE, LONGEST, PADDING = 110, 70, 4

local function widths(tbl)
  local most, wide = {}, false
  for _, body in ipairs(tbl.bodies) do
    for _, row in ipairs(body.body) do
      for n, cell in ipairs(row.cells) do
        local length = utf8.len(pandoc.utils.stringify(cell.contents))
        wide = wide or length > LONGEST
        most[n] = math.max(most[n] or 0, math.min(length, LONGEST) + PADDING)
      end
    end
  end
  local total = 0
  for _, length in ipairs(most) do total = total + length end
  return most, total, wide or total > LINE
end

function Table(tbl)
  if not is_typst() then
    local attributes = { { "tabindex", "0" }, { "role", "region" }, { "aria-label", "Table" } }
    return pandoc.Div({ tbl }, pandoc.Attr("", { "scroll" }, attributes))
  end
  local most, total, wide = widths(tbl)
  if wide then
    for n, spec in ipairs(tbl.colspecs) do tbl.colspecs[n] = { spec[1], most[n] / total } end
  end
  return tbl
end

return { { Meta = Meta }, { Math = Math, Header = Header, Span = Span, Link = Link, Image = Image, Table = Table } }
