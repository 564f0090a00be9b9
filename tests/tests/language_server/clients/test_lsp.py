"""The language server through pytest-lsp, which plays Visual Studio Code."""

import os

import pytest
import pytest_lsp
from lsprotocol import types as t
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities

URI = "file:///x/a.sense"
TEXT = "/* \U0001d11e */ sensor Leg returns uint16 { id = 1; type = analgo; }\nboard B on STM32F407G_DISC1 {}\n"


@pytest_lsp.fixture(config=ClientServerConfig(server_command=[os.environ["SENSEDSL"], "lsp"]))
async def client(lsp_client: LanguageClient):
    # pytest-lsp says that it can draw again, and has nothing that does.
    for method in ["workspace/codeLens/refresh", "workspace/inlayHint/refresh"]:
        lsp_client.feature(method)(lambda *_: None)
    capabilities = client_capabilities("visual-studio-code")
    await lsp_client.initialize_session(t.InitializeParams(capabilities=capabilities, root_uri="file:///x"))
    yield
    await lsp_client.shutdown_session()


async def opened(client: LanguageClient, text: str) -> list[t.Diagnostic]:
    item = t.TextDocumentItem(URI, "sensedsl", 1, text)
    client.text_document_did_open(t.DidOpenTextDocumentParams(item))
    await client.wait_for_notification(t.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    return client.diagnostics[URI]


@pytest.mark.asyncio
async def test_a_mistake_is_told_at_its_place_and_goes(client: LanguageClient):
    (one,) = [d for d in await opened(client, TEXT) if d.severity == t.DiagnosticSeverity.Error]
    column = len(TEXT.split("analgo")[0].encode("utf-16-le")) // 2
    assert (one.range.start.character, one.range.end.character) == (column, column + 6)
    change = t.TextDocumentContentChangePartial(range=one.range, text="analog")
    version = t.VersionedTextDocumentIdentifier(version=2, uri=URI)
    client.text_document_did_change(t.DidChangeTextDocumentParams(version, [change]))
    await client.wait_for_notification(t.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    assert not [d for d in client.diagnostics[URI] if d.severity == t.DiagnosticSeverity.Error]


@pytest.mark.asyncio
async def test_features_answer_in_the_types_of_the_protocol(client: LanguageClient):
    await opened(client, TEXT.replace("analgo", "analog"))
    file = t.TextDocumentIdentifier(URI)
    at = t.Position(0, 17)
    hover = await client.text_document_hover_async(t.HoverParams(file, at))
    assert "Leg" in hover.contents.value
    hints = await client.text_document_inlay_hint_async(
        t.InlayHintParams(file, t.Range(t.Position(0, 0), t.Position(3, 0)))
    )
    assert any("→" in hint.label for hint in hints)
    lenses = await client.text_document_code_lens_async(t.CodeLensParams(file))
    assert lenses
    symbols = await client.text_document_document_symbol_async(t.DocumentSymbolParams(file))
    assert {one.name for one in symbols} == {"Leg", "B"}
    tokens = await client.text_document_semantic_tokens_full_async(t.SemanticTokensParams(file))
    assert len(tokens.data) % 5 == 0 and tokens.data
    folds = await client.text_document_folding_range_async(t.FoldingRangeParams(file))
    assert not folds
    edit = await client.text_document_rename_async(t.RenameParams(file, at, "Arm"))
    assert [one.new_text for one in edit.changes[URI]] == ["Arm"]
    places = await client.text_document_references_async(
        t.ReferenceParams(context=t.ReferenceContext(True), text_document=file, position=at)
    )
    assert len(places) == 1
    selection = await client.text_document_selection_range_async(t.SelectionRangeParams(file, [at]))
    assert selection[0].parent is not None
