-- What a page needs beyond plain Markdown, for HTML and for Typst alike.
local page, titles, paper, equations = nil, {}, nil, {}

local function is_typst() return FORMAT:match("typst") ~= nil end

function Meta(meta)
  page = pandoc.utils.stringify(meta.page)
  titles = meta.titles or titles
  paper = meta.paper
  equations = meta.equations or equations
end

-- In HTML the number of an equation of the chapter says what that is.
local function Explained(str)
  local before, number, after = str.text:match("^(.-)%((10%.%d+)%)(.*)$")
  if is_typst() or not number or not equations[number] then return nil end
  local said = pandoc.Span("(" .. number .. ")", { class = "equation", title = pandoc.utils.stringify(equations[number]) })
  return { pandoc.Str(before), said, pandoc.Str(after) }
end

-- Headings are names, too, of navigation and search.
local function Plain(header)
  return header:walk({ Span = function(span) if span.classes:includes("equation") then return span.content end end })
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
  if name then
    image.src = "figures/" .. name .. ".svg"
  elseif image.src:match("^[%w_]+%.png$") then -- beside the document
    image.src = "figures/" .. image.src
  end
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
  if name == "findings" then name = "index" end
  if next(titles) and not titles[name] then return link.content end -- a document that the report lacks
  -- In the repository a document is called by its file, in the report by its title.
  if titles[name] and pandoc.utils.stringify(link.content) == name .. ".md" then
    link.content = pandoc.Inlines(titles[name])
  end
  if is_typst() then
    if paper and not paper[name] then return link.content end -- a page that is on the site alone
    link.target = "#" .. name .. (anchor ~= "" and "-" .. anchor:sub(2) or "")
  else
    link.target = name .. ".html" .. anchor
  end
  return link
end

-- In HTML a wide table scrolls by itself (live/scroll.js). On paper its columns share the width by what they
-- hold, with room for the longest word, since equal shares would leave long text in a narrow one.
local LINE, LONGEST, PADDING, WORD = 110, 70, 4, 12

local function column(tbl, n)
  local longest, word, held = 0, 0, 0
  local function measure(cell)
    local text = pandoc.utils.stringify(cell.contents)
    for part in text:gmatch("[^%s%-_/]+") do word = math.max(word, math.min(utf8.len(part), WORD) + 2) end
    return utf8.len(text)
  end
  measure(tbl.head.rows[1].cells[n])
  for _, row in ipairs(tbl.bodies[1].body) do
    local length = measure(row.cells[n])
    longest, held = math.max(longest, length), held + length
  end
  return longest, word, held
end

-- Of the columns, and whether the table is too wide for a line.
local function shares(tbl)
  local words, held, all, line, total = {}, {}, 0, 0, 0
  for n = 1, #tbl.colspecs do
    local longest
    longest, words[n], held[n] = column(tbl, n)
    all = all + held[n]
    line = longest > LONGEST and math.huge or line + longest + PADDING
  end
  for n, word in ipairs(words) do
    held[n] = math.max(word, LINE * held[n] / all)
    total = total + held[n]
  end
  for n, part in ipairs(held) do held[n] = part / total end
  return held, line > LINE
end

local function has_math(block)
  local found = false
  block:walk({ Math = function() found = true end })
  return found
end

-- On a phone a row of a wide table is a card, where each cell says the head of its column; a formula cannot be said so.
local function as_cards(tbl)
  local heads = {}
  for n, cell in ipairs(tbl.head.rows[1].cells) do
    if cell.contents:find_if(has_math) then return {} end
    heads[n] = pandoc.utils.stringify(cell.contents)
  end
  for _, body in ipairs(tbl.bodies) do
    for _, row in ipairs(body.body) do
      for n, cell in ipairs(row.cells) do cell.attributes.of = heads[n] end
    end
  end
  return { "cards" }
end

function Table(tbl)
  local columns, wide = shares(tbl)
  if not is_typst() then
    local heads = tbl.head.rows[1].cells:map(function(cell) return pandoc.utils.stringify(cell.contents) end)
    local attributes = { { "role", "region" }, { "aria-label", "Table: " .. table.concat(heads, ", ") } }
    local classes = wide and #columns > 2 and as_cards(tbl) or {}
    return pandoc.Div({ tbl }, pandoc.Attr("", { "scroll", table.unpack(classes) }, attributes))
  end
  if wide then
    for n, spec in ipairs(tbl.colspecs) do tbl.colspecs[n] = { spec[1], columns[n] } end
  end
  return tbl
end

return { { Meta = Meta }, { Str = Explained }, { Header = Plain, Link = Plain }, { Math = Math, Header = Header, Span = Span, Link = Link, Image = Image, Table = Table } }
